#include "units/ground_truth/model.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/at.h"

using namespace ground_truth;
using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using namespace std::chrono_literals;

namespace {

const Quantity kTemperature{"degC", "K"};

using stride::tests::at;

Parameters parameters(double tolerance, Duration max_age = 0s) {
  return {tolerance, max_age, 3600s, 1};
}

/// The truth rises by 1 K/s from 20 degC, and is noted each 0.1 s for 10 s.
Judge rising(const Parameters& parameters) {
  Judge judge(parameters, kTemperature);
  for (int i = 0; i <= 100; ++i) judge.note(at(0.1 * i), 20 + 0.1 * i);
  return judge;
}

Finding finding(Judge judge, const Measurement& measurement) {
  return judge.compare(measurement).finding;
}

}  // namespace

TEST_CASE("a new measurement is compared with the truth of its instant") {
  const Judge judge = rising(parameters(0.25));
  CHECK(finding(judge, {at(10), 30.2, {}, {}}) == Finding::Right);
  CHECK(finding(judge, {at(10), 29.6, {}, {}}) == Finding::Wrong);
  CHECK(finding(judge, {at(10), 30.3, {}, {}}) == Finding::Wrong);
}

TEST_CASE("it may be as old as it is allowed to be, and no older") {
  const Judge judge = rising(parameters(0.25, 2s));
  CHECK(finding(judge, {at(10), 27.8, {}, {}}) == Finding::Right);  // 28 two seconds ago
  CHECK(finding(judge, {at(10), 27.6, {}, {}}) == Finding::Wrong);
  CHECK(finding(judge, {at(10), 30.3, {}, {}}) == Finding::Wrong);  // not in the future
}

TEST_CASE("a measurement with an age is compared with the truth at that time") {
  const Judge judge = rising(parameters(0.25));
  CHECK(finding(judge, {at(10), 25.0, 5s, {}}) == Finding::Right);
  CHECK(finding(judge, {at(10), 30.0, 5s, {}}) == Finding::Wrong);
  // whole seconds, rounded down: 5 to 6 seconds
  CHECK(finding(judge, {at(10), 24.0, 5s, {}}) == Finding::Wrong);
  CHECK(finding(judge, {at(10), 24.0, 5s, 1s}) == Finding::Right);
  CHECK(finding(judge, {at(10), 23.4, 5s, 1s}) == Finding::Wrong);
  CHECK(finding(rising(parameters(0.25, 1s)), {at(10), 23.4, 5s, 1s}) == Finding::Right);
}

TEST_CASE("the error is the least that an instant leaves") {
  Judge judge = rising(parameters(0.5, 2s));
  const Comparison high = judge.compare({at(10), 31.0, {}, {}});
  CHECK(high.deviation.truth == 30.0);
  CHECK(high.deviation.error == 1.0);
  const Comparison low = judge.compare({at(10), 27.0, {}, {}});
  CHECK(low.deviation.truth == Approx(28.0).margin(0.5 / 64 + 2.0 / 16));
  CHECK(low.deviation.error < -0.8);
  CHECK(judge.compare({at(10), 29.0, {}, {}}).deviation.error == 0.0);
  CHECK(low.from == at(8));
  CHECK(low.to == at(10));
}

TEST_CASE("what was before the start, or is forgotten, makes nothing wrong") {
  Judge judge = rising(parameters(0.25));
  CHECK(judge.compare({at(10), 50.0, 11s, {}}).finding == Finding::Unknown);
  CHECK(judge.compare({at(10), 50.0, 9s, 2s}).finding == Finding::Unknown);
  CHECK(judge.compare({at(10), 20.5, 9s, 2s}).finding == Finding::Right);
  // as old as can be said, and more than can be counted
  const Duration longest = stride::duration_from_seconds(stride::kMaxSeconds);
  CHECK(judge.compare({at(10), 50.0, 65535s, longest}).finding == Finding::Unknown);
  CHECK(judge.compare({at(10), 50.0, longest, longest}).finding == Finding::Unknown);
  CHECK(judge.state().unknown == 4);
  CHECK(judge.compared() == 1);
  CHECK(judge.passed());

  Judge forgetful({0.25, 0s, 3s, 0}, kTemperature);
  for (int i = 0; i <= 100; ++i) forgetful.note(at(0.1 * i), 20 + 0.1 * i);
  CHECK(forgetful.compare({at(10), 50.0, 2s, {}}).finding == Finding::Wrong);
  CHECK(forgetful.compare({at(10), 50.0, 4s, {}}).finding == Finding::Unknown);
}

TEST_CASE("one wrong measurement, or too few, and the verdict is bad") {
  Judge judge = rising({0.25, 0s, 3600s, 2});
  CHECK_FALSE(judge.passed());
  judge.compare({at(10), 30.0, {}, {}});
  CHECK_FALSE(judge.passed());
  judge.compare({at(10), 30.1, {}, {}});
  CHECK(judge.passed());
  judge.compare({at(10), 31.0, {}, {}});
  CHECK_FALSE(judge.passed());
  judge.compare({at(10), 30.0, {}, {}});
  CHECK_FALSE(judge.passed());
  CHECK(judge.state().right == 3);
  CHECK(judge.state().wrong == 1);
  CHECK(Judge({0.25, 0s, 3600s, 0}, kTemperature).passed());
}

TEST_CASE("the worst is the first with the largest error, right or wrong") {
  Judge judge = rising(parameters(0.25));
  judge.compare({at(10), 30.1, {}, {}});
  CHECK(judge.state().worst.error == Approx(0.1));
  judge.compare({at(10), 28.5, {}, {}});
  judge.note(at(11), 30.0);
  judge.compare({at(11), 31.0, {}, {}});
  judge.compare({at(11), 30.0, {}, {}});
  CHECK(judge.state().worst.error < -1.3);
  CHECK(judge.state().worst.measured == 28.5);
  CHECK(judge.state().worst.received == at(10));
  CHECK(judge.state().last.error == 0.0);
}

TEST_CASE("the verdict in words") {
  Judge judge({0.25, 0s, 3600s, 2}, kTemperature);
  CHECK(judge.verdict_text() == "0 of 0 measurements right; expected at least 2");
  judge.note(at(1), 21.5);
  judge.compare({at(1), 21.6, {}, {}});
  CHECK(judge.verdict_text() ==
        "1 of 1 measurement right; expected at least 2; worst error 0.1 K at 1 s: 21.6 degC for "
        "21.5 degC");
  judge.compare({at(1), 20.0, {}, {}});
  judge.compare({at(1), 20.0, 2s, {}});
  CHECK(judge.verdict_text() ==
        "1 of 2 measurements right; 1 too old to be checked; worst error -1.5 K at 1 s: 20 degC "
        "for 21.5 "
        "degC");
}

TEST_CASE("a wrong measurement is reported with all that is needed to find it") {
  Judge judge({0.25, 500ms, 3600s, 1}, kTemperature);
  judge.note(at(0), 21.5);
  judge.note(at(3), 21.5);
  CHECK(judge.text_of(judge.compare({at(3), 23.0, 1s, {}})) ==
        "measurement at 3 s: 23 degC is wrong, error 1.5 K, tolerance 0.25 K; the nearest truth "
        "between 1.5 s and 2 s is 21.5 degC");
  CHECK(judge.text_of(judge.compare({at(3), 23.0, 2600ms, {}})) ==
        "measurement at 3 s: 23 degC was made between -0.1 s and 0.4 s, of which the truth is not "
        "remembered; it is not compared");
}

TEST_CASE("parameters and values that cannot be") {
  CHECK_THROWS_WITH(Judge(parameters(-1), kTemperature), "tolerance is -1: expected 0 or more");
  CHECK_THROWS_WITH(Judge(parameters(std::nan("")), kTemperature), Contains("tolerance is"));
  CHECK_THROWS_WITH(Judge(parameters(1, -1s), kTemperature), Contains("max_age"));
  CHECK_THROWS_WITH(Judge({1, 0s, -1s, 1}, kTemperature), Contains("memory"));
  Judge judge = rising(parameters(1));
  CHECK_THROWS_WITH(judge.compare({at(10), std::nan(""), {}, {}}), Contains("not a finite number"));
  CHECK_THROWS(judge.compare({at(10), std::numeric_limits<double>::infinity(), {}, {}}));
}
