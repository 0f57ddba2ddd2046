#include "master/study/compare/signals/recorded_signals.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

RecordedSignals recorded(const std::string& text,
                         const std::vector<report::SignalInfo>& infos = {}) {
  const TemporaryFolder folder;
  return read_recorded_signals(folder.write("signals.csv", text), infos);
}

}  // namespace

TEST_CASE("all rows are read, also several at one instant") {
  const RecordedSignals signals = recorded("time,a.x [m],a.on\n0,1,true\n1,2,true\n1,3,false\n");
  CHECK(signals.times == std::vector<Time>{Time(), Time(kSecond), Time(kSecond)});
  REQUIRE(signals.columns.size() == 2);
  CHECK(signals.columns[0].name() == "a.x");
  CHECK(signals.columns[0].unit() == "m");
  CHECK(signals.columns[0].text(2) == "3");
  CHECK(signals.columns[1].text(1) == "true");
  CHECK_FALSE(signals.cut);
}

TEST_CASE("types are those of run.json, where it has them") {
  const RecordedSignals signals =
      recorded("time,a.x\n0,007\n", {{"a.x", "", core::ValueType::Binary, false}});
  CHECK(signals.columns.at(0).text(0) == "007");
  CHECK(recorded("time,a.x\n0,1e2\n").columns.at(0).text(0) == "100");
}

TEST_CASE("a last line without its end was cut off") {
  const RecordedSignals signals = recorded("time,a.x\n0,1\n1,2");
  CHECK(signals.times.size() == 1);
  CHECK(signals.cut == 3);
  CHECK_THAT(error_of([] { recorded(""); }), Contains("the file is empty"));
}

TEST_CASE("mistakes are named with line and column") {
  CHECK_THAT(error_of([] { recorded("t,a.x\n"); }),
             Contains("signals.csv:1: ") && Contains("expected the column 'time'"));
  CHECK_THAT(error_of([] { recorded("time,a.x\n1,1\n0,1\n"); }),
             Contains("signals.csv:3: ") && Contains("the time goes back"));
  CHECK_THAT(error_of([] { recorded("time,a.x\n1,1,2\n"); }),
             Contains("signals.csv:2: expected 2 fields"));
  CHECK_THAT(error_of([] {
               recorded("time,a.x\n1,1\n2,x\n", {{"a.x", "", core::ValueType::Float64, true}});
             }),
             Contains("signals.csv:3: ") && Contains("a.x") && Contains("expected a number"));
  CHECK_THAT(error_of([] { recorded("time,a.x [m],a.x [s]\n"); }),
             Contains("signals.csv:1: two columns have the name 'a.x'"));
}
