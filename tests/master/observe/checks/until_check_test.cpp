#include "master/observe/checks/until_check.h"

#include <cmath>
#include <memory>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using core::ValueType;

namespace {

struct UntilPoint {
  std::int64_t time;  // ms
  double voltage;
  bool is_lit;
};
using UntilCourse = std::vector<UntilPoint>;

/// At least 1.5 V until the lamp is lit.
Definition until_lit(Window of) {
  ConditionText low, lit;
  low.min = "1.5";
  lit.equals = "true";
  const core::Variable voltage = variable(ValueType::Float64, "V");
  const core::Variable lamp = variable(ValueType::Boolean);
  return {Kind::Until,
          "supplied until lit",
          "",
          of,
          {"x.ssd", 7},
          UntilDemand{{{0, 0}, 1, "a.x", "V", Condition(voltage, low)},
                      {{1, 0}, 0, "b.x", "", Condition(lamp, lit)}}};
}

/// In one run, or resumed at each point.
core::Verdict judged_until(const Definition& definition, const UntilCourse& course,
                           const Ending& ending, bool is_resumed) {
  core::ValueBlock voltages(ValueType::Float64, 3), lamps(ValueType::Boolean, 1);
  const auto make = [&] {
    auto check = std::make_unique<UntilCheck>(definition);
    const std::vector<core::VariableId> ids = check->signals();
    REQUIRE(ids.size() == 2);
    const core::Signal signals[] = {{ids[0], &voltages, 1}, {ids[1], &lamps, 0}};
    check->attach(signals);
    return check;
  };
  auto check = make();
  for (const UntilPoint& sample : course) {
    voltages.numbers<double>()[2] = sample.voltage;
    lamps.numbers<bool>()[0] = sample.is_lit;
    check->on_point(at(sample.time));
    if (!is_resumed) continue;
    auto other = make();
    take_over(*other, *check);
    check = std::move(other);
  }
  return check->verdict(ending);
}

core::Verdict judged_until(const Definition& definition, const UntilCourse& course,
                           const Ending& ending) {
  core::Verdict verdict = judged_until(definition, course, ending, false);
  CHECK(text_of(judged_until(definition, course, ending, true)) == text_of(verdict));
  return verdict;
}

}  // namespace

TEST_CASE("until: it passes where the condition comes while the signal keeps to its own") {
  const UntilCourse course{{0, 3, false}, {10, 2, false}, {20, 1, true}, {30, 0, false}};
  const auto verdict = judged_until(until_lit({}), course, ended(30));
  CHECK(verdict.passed == true);
  CHECK(verdict.kind == "until");
  CHECK(verdict.text == "until 0.02 s: b.x was true");
  CHECK(margin_of(verdict) == "0.5 V at 0.01 s");
}

TEST_CASE("until: at the instant that ends it, nothing else counts") {
  const auto verdict = judged_until(until_lit({}), {{0, 0, true}, {10, 0, false}}, ended(10));
  CHECK(verdict.passed == true);
  CHECK(margin_of(verdict) == "1 at 0 s");
}

TEST_CASE("until: it fails where the signal leaves what it has to keep to") {
  const UntilCourse course{{0, 3, false}, {10, 1.25, false}, {20, 3, true}};
  const auto verdict = judged_until(until_lit({}), course, ended(20));
  CHECK(verdict.passed == false);
  CHECK(verdict.time == at(10));
  CHECK(verdict.text == "a.x was 1.25 V; expected >= 1.5 V until b.x = true");
  CHECK(margin_of(verdict) == "-0.25 V at 0.01 s");
  REQUIRE(verdict.values.size() == 1);
  CHECK(verdict.values.front().value.numbers<double>()[0] == 1.25);
}

TEST_CASE("until: it fails at the end of the interval if the condition has not come") {
  const auto verdict =
      judged_until(until_lit(window({}, 20)), {{0, 3, false}, {20, 3, false}}, ended(40));
  CHECK(verdict.passed == false);
  CHECK(verdict.time == at(20));
  CHECK(verdict.text == "b.x was false; expected = true");
  CHECK(margin_of(verdict) == "-1 at 0 s");
}

TEST_CASE("until: what is before the interval, or behind it, does not count") {
  const UntilCourse course{{0, 0, true}, {10, 2, false}, {20, 2, true}, {30, 0, false}};
  CHECK(judged_until(until_lit(window(10, 20)), course, ended(30)).passed == true);
  const UntilCourse late{{0, 0, true}, {10, 2, false}, {20, 2, false}, {30, 2, true}};
  CHECK(judged_until(until_lit(window(10, 20)), late, ended(30)).passed == false);
}

TEST_CASE("until: NaN is never what it should be") {
  const auto verdict =
      judged_until(until_lit({}), {{0, std::nan(""), false}, {10, 3, true}}, ended(10));
  CHECK(verdict.passed == false);
  CHECK(verdict.time == at(0));
}

TEST_CASE("until: a run that breaks off leaves it undecided, unless it was decided") {
  CHECK_FALSE(judged_until(until_lit({}), {{0, 3, false}}, broke(10)).passed.has_value());
  CHECK(judged_until(until_lit({}), {{0, 3, true}}, broke(10)).passed == true);
  CHECK(judged_until(until_lit({}), {{0, 1, false}}, broke(10)).passed == false);
  CHECK(
      judged_until(until_lit(window({}, 10)), {{0, 3, false}, {10, 3, false}}, broke(10)).passed ==
      false);
}

TEST_CASE("until: an interval without a communication point is undecided") {
  const auto verdict =
      judged_until(until_lit(window(3, 7)), {{0, 3, true}, {10, 3, true}}, ended(10));
  CHECK_FALSE(verdict.passed.has_value());
  CHECK(margin_of(verdict) == "none");
}
