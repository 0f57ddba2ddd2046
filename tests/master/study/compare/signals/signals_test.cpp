#include "master/study/compare/signals/signals.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

const report::SignalInfo kLevel{"tank.level", "m", core::ValueType::Float64, true};
const report::SignalInfo kCount{"tank.count", "", core::ValueType::Int32, false};

RecordedSignals recorded_of(const std::string& text,
                            const std::vector<report::SignalInfo>& infos = {kLevel, kCount}) {
  const TemporaryFolder folder;
  return read_recorded_signals(folder.write("signals.csv", text), infos);
}

Differences differences_of(const std::string& a, const std::string& b,
                           const Settings& settings = {}) {
  return compare_signals(recorded_of(a), recorded_of(b), settings,
                         Selection(settings.only, settings.ignored), "signals.csv");
}

const char* const kSignals = "time,tank.level [m],tank.count\n0,1,0\n1,2,1\n";

}  // namespace

TEST_CASE("the same rows are equal") { CHECK(differences_of(kSignals, kSignals).empty()); }

TEST_CASE("each signal with other values is one difference") {
  const Differences differences =
      differences_of(kSignals, "time,tank.level [m],tank.count\n0,1,0\n1,2.5,2\n");
  REQUIRE(names_of(differences) == Names{"signal tank.level", "signal tank.count"});
  CHECK(differences[0].time == Time(kSecond));
  CHECK(differences[0].a == "2");
  CHECK(differences[0].b == "2.5");
  CHECK(differences[0].absolute->value == 0.5);
  CHECK(differences[0].relative->value == 0.2);
  CHECK(differences[1].a == "1");
}

TEST_CASE("signals that one run has not are differences") {
  const Differences differences =
      differences_of(kSignals, "time,tank.level [m],tank.v\n0,1,0\n1,2,1\n");
  REQUIRE(names_of(differences) == Names{"signal tank.count", "signal tank.v"});
  CHECK(differences[0].a == "recorded");
  CHECK(differences[0].b == "none");
  CHECK(differences[1].b == "recorded");
}

TEST_CASE("another unit of measure, and another order of the columns, is a difference") {
  const Differences units =
      differences_of(kSignals, "time,tank.level [mm],tank.count\n0,1,0\n1,2,1\n");
  REQUIRE(names_of(units) == Names{"signal tank.level"});
  CHECK(units[0].b == "in [mm]");
  CHECK(names_of(differences_of(kSignals, "time,tank.count,tank.level [m]\n0,0,1\n1,1,2\n")) ==
        Names{"file signals.csv"});
}

TEST_CASE("rows that one run has not are a difference, and the others are compared") {
  const Differences differences =
      differences_of(kSignals, "time,tank.level [m],tank.count\n0,1,0\n0.5,1,0\n0.75,9,9\n1,2,2\n");
  REQUIRE(names_of(differences) == Names{"file signals.csv", "signal tank.count"});
  CHECK(differences[0].time == Time(kSecond / 2));
  CHECK(differences[0].a == "none");
  CHECK(differences[0].b == kRow);
  CHECK(differences[0].count == 2);
}

TEST_CASE("a golden B may have fewer rows, but not others") {
  const Settings golden{.is_golden = true};
  const std::string few = "time,tank.level [m],tank.count\n1,2,1\n";
  CHECK(differences_of(kSignals, few, golden).empty());
  CHECK(names_of(differences_of(few, kSignals, golden)) == Names{"file signals.csv"});
  CHECK(names_of(differences_of(kSignals, few)) == Names{"file signals.csv"});
}

TEST_CASE("tolerances are those of reals, and of the signal") {
  const std::string other = "time,tank.level [m],tank.count\n0,1.125,0\n1,2.125,2\n";
  CHECK(names_of(differences_of(kSignals, other, {.tolerance = {0.125, 0}})) ==
        Names{"signal tank.count"});
  CHECK(differences_of(kSignals, other, {.tolerances = {{"tank.level", {0.125, 0}, {}}}}).size() ==
        1);
  CHECK(differences_of(kSignals, other, {.tolerances = {{"tank.*", {0, 0.1}, {}}}}).size() == 2);
  CHECK_THAT(error_of([&] {
               differences_of(kSignals, other, {.tolerances = {{"tank.levle", {}, {}}}});
             }),
             Contains("'tank.levle' is no signal"));
}

TEST_CASE("what is not selected is not compared") {
  const std::string other = "time,tank.level [m],tank.v\n0,1,0\n1,3,1\n";
  CHECK(names_of(differences_of(kSignals, other, {.only = {"tank.level"}})) ==
        Names{"signal tank.level"});
  CHECK(
      differences_of(kSignals, other, {.ignored = {"tank.level", "tank.count", "tank.v"}}).empty());
}

TEST_CASE("with a tolerance of time signals are curves: straight, or held as run.json has it") {
  const Settings curves{.time_tolerance = Duration()};
  const std::string whole = "time,tank.level [m],tank.count\n0,0,0\n1,1,1\n";
  const std::string halves = "time,tank.level [m],tank.count\n0,0,0\n0.5,0.5,0\n1,1,1\n";
  CHECK(differences_of(whole, halves, curves).empty());
  const std::string early = "time,tank.level [m],tank.count\n0,0,0\n0.5,0,1\n1,1,1\n";
  CHECK(names_of(differences_of(whole, early, curves)) ==
        Names{"signal tank.level", "signal tank.count"});
}

TEST_CASE("a signal is held if one of the runs says so") {
  const Settings curves{.time_tolerance = Duration()};
  report::SignalInfo held = kLevel;
  held.is_continuous = false;
  const std::string whole = "time,tank.level [m]\n0,0\n1,1\n";
  const std::string halves = "time,tank.level [m]\n0,0\n0.5,0.5\n1,1\n";
  const Selection all({}, {});
  CHECK(compare_signals(recorded_of(whole), recorded_of(halves, {held}), curves, all, "").size() ==
        1);
  CHECK(compare_signals(recorded_of(whole, {held}), recorded_of(halves), curves, all, "").size() ==
        1);
}

TEST_CASE("a run that ends earlier, or begins later, differs, but for the tolerance of time") {
  const std::string longer = "time,tank.level [m],tank.count\n0,1,0\n1,1,0\n3,1,0\n";
  const std::string shorter = "time,tank.level [m],tank.count\n0,1,0\n1,1,0\n";
  const Differences differences = differences_of(longer, shorter, {.time_tolerance = Duration()});
  REQUIRE(names_of(differences) == Names{"file signals.csv"});
  CHECK(differences[0].a == "rows until 3 s");
  CHECK(differences[0].b == "rows until 1 s");
  CHECK(differences[0].time == Time(kSecond));
  CHECK(differences_of(longer, shorter, {.time_tolerance = 2 * kSecond}).empty());
  CHECK(differences_of(longer, shorter, {.time_tolerance = Duration(), .is_golden = true}).empty());
  CHECK(differences_of(shorter, longer, {.time_tolerance = Duration(), .is_golden = true}).size() ==
        1);
  CHECK(differences_of(shorter, "time,tank.level [m],tank.count\n1,1,0\n",
                       {.time_tolerance = Duration()})
            .at(0)
            .b == "rows from 1 s on");
  CHECK(differences_of(shorter, "time,tank.level [m],tank.count\n", {.time_tolerance = Duration()})
            .at(0)
            .b == "no rows");
}
