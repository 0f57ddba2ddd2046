#include "master/study/verify/recording.h"

#include "tests/at.h"
#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::verify;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using tests::at;

namespace {

const TestedUnit& tested() {
  static const TestedUnit tested(VerifyRequest{.file = tests::unit_folder() / "minimal.fmu"});
  return tested;
}

constexpr Duration kMilli = std::chrono::milliseconds(1);

Row point(Duration time, const std::string& value) { return {Time(time), {value}, false}; }
Row event(Duration time, const std::string& value) { return {Time(time), {value}, true}; }

std::string compare(const std::vector<Row>& expected, const std::vector<Row>& seen) {
  return difference(tested(), expected, seen, "here", "there").value_or("");
}

}  // namespace

TEST_CASE("the first value that differs is named with both values and its time") {
  CHECK(compare({point({}, "1"), point(kMilli, "2")}, {point({}, "1"), point(kMilli, "2")}) == "");
  CHECK(compare({point({}, "1"), point(kMilli, "2"), point(2 * kMilli, "3")},
                {point({}, "1"), point(kMilli, "2.5"), point(2 * kMilli, "3.5")}) ==
        "at 0.001 s 'y' is 2 here, and 2.5 there");
  CHECK(compare({point({}, "0")}, {point({}, "-0")}) != "");
}

TEST_CASE("of small differences the size is told, and rounding is none") {
  const std::vector<Row> one{point({}, "1"), point(kMilli, "2")};
  const std::vector<Row> near{point({}, "1"), point(kMilli, "2.00001")};
  CHECK(compare(one, near) ==
        "at 0.001 s 'y' is 2 here, and 2.00001 there; all differences are within 5e-06 of the "
        "variables' largest values");
  std::string note;
  CHECK(difference_beyond_rounding(tested(), one, near, "here", "there", note));
  CHECK(note.empty());
  const std::vector<Row> rounded{point({}, "1"), point(kMilli, "2.0000000000000004")};
  CHECK_FALSE(difference_beyond_rounding(tested(), one, rounded, "here", "there", note));
  CHECK_THAT(note, Contains("within 2e-16"));
  CHECK(difference_beyond_rounding(tested(), {event({}, "n=1"), point({}, "1")},
                                   {event({}, "n=2"), point({}, "1")}, "here", "there", note));
}

TEST_CASE("an event that is missing, and a run that ends, differ") {
  CHECK(compare({event(kMilli, "tick")}, {point(kMilli, "1")}) ==
        "there is the event tick at 0.001 s here, and no event at 0.001 s there");
  CHECK_THAT(compare({event(kMilli, "n=1")}, {event(kMilli, "n=2")}),
             Contains("at 0.001 s the event n=1 is n=2 there"));
  CHECK(compare({point({}, "1")}, {}) != "");
  CHECK(compare({point({}, "1"), point(kMilli, "1")}, {point({}, "1")}) ==
        "nothing follows after 0 s there, but something does here");
}

TEST_CASE("a recording survives the way through its text") {
  Recording recording{{point({}, "1e-300"), event(5s, "frame=00ff"), point(7s, "\xff not UTF-8")}};
  recording.steps = {
      {at(0), at(5), false, true}, {at(5), at(5), true}, {at(5), at(7), false, false, true}};
  recording.rejections = 3;
  recording.early_returns = 4;
  recording.first_early_return = at(5);
  recording.longest_promise = Duration::max();
  recording.longest_suspension = 3s;
  recording.events = 6;
  recording.has_ended = true;
  Recording back = recording_from_text(to_text(recording));
  CHECK(back.rows[2].values[0].find(" not UTF-8") != std::string::npos);
  back.rows[2] = recording.rows[2];
  CHECK(back == recording);
  CHECK(recording.without_events().rows.size() == 2);
}
