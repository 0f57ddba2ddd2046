#include "master/observe/checks/signal_check.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using core::ValueType;

namespace {

using Course = std::vector<std::pair<std::int64_t, double>>;  // ms and value

Definition demand(Kind kind, Window of, const std::string& min) {
  ConditionText text;
  text.min = min;
  const core::Variable voltage = variable(ValueType::Float64, "V");
  return {kind, "voltage",    "",
          of,   {"x.ssd", 7}, SignalDemand{{0, 0}, 1, "a.x", "V", Condition(voltage, text)}};
}

/// In one run, or resumed at each point.
core::Verdict judged(const Definition& definition, const Course& course, const Ending& ending,
                     bool is_resumed) {
  core::ValueBlock block(ValueType::Float64, 3);
  const auto make = [&] {
    auto check = std::make_unique<SignalCheck>(definition);
    const core::Signal signal{check->signals().front(), &block, 1};
    check->attach({&signal, 1});
    return check;
  };
  auto check = make();
  for (const auto& [time, value] : course) {
    block.numbers<double>()[2] = value;
    check->on_point(at(time));
    if (!is_resumed) continue;
    auto other = make();
    take_over(*other, *check);
    check = std::move(other);
  }
  return check->verdict(ending);
}

core::Verdict judged(const Definition& definition, const Course& course, const Ending& ending) {
  core::Verdict verdict = judged(definition, course, ending, false);
  CHECK(text_of(judged(definition, course, ending, true)) == text_of(verdict));
  return verdict;
}

const Course kFalls{{0, 3}, {10, 2}, {20, 1.5}, {30, 1}, {40, 4}};

}  // namespace

TEST_CASE("always: the first value that is not as it should be, with its instant") {
  const auto verdict = judged(demand(Kind::Always, {}, "1.8"), kFalls, ended(40));
  CHECK(verdict.passed == false);
  CHECK(verdict.time == at(20));
  CHECK(verdict.text == "1.5 V; expected >= 1.8 V");
  CHECK((verdict.name == "voltage" && verdict.kind == "always" && verdict.where.line == 7));
  REQUIRE(verdict.values.size() == 1);
  CHECK(verdict.values[0].signal == "a.x");
  CHECK(verdict.values[0].unit == "V");
  CHECK(verdict.values[0].value.numbers<double>()[0] == 1.5);
}

TEST_CASE("always: the interval's ends belong to it, and nothing else does") {
  CHECK(judged(demand(Kind::Always, window(0, 10), "1.8"), kFalls, ended(40)).passed == true);
  CHECK(judged(demand(Kind::Always, window(31, 40), "1.8"), kFalls, ended(40)).passed == true);
  CHECK(judged(demand(Kind::Always, window(10, 20), "1.8"), kFalls, ended(40)).time == at(20));
  CHECK(judged(demand(Kind::Always, window(30, 40), "1.8"), kFalls, ended(40)).time == at(30));
  CHECK(judged(demand(Kind::Always, window(0, 10), "1.8"), kFalls, ended(40)).text ==
        "it was between 2 V and 3 V");
}

TEST_CASE("never: the other way round") {
  CHECK(judged(demand(Kind::Never, {}, "5"), kFalls, ended(40)).passed == true);
  const auto verdict = judged(demand(Kind::Never, window(10, {}), "4"), kFalls, ended(40));
  CHECK((verdict.passed == false && verdict.time == at(40)));
  CHECK(verdict.text == "4 V; expected never >= 4 V");
}

TEST_CASE("NaN fails what is to be so always, and what is never to be so") {
  const Course course{{0, 3}, {10, std::nan("")}, {20, 3}};
  CHECK(judged(demand(Kind::Always, {}, "1.8"), course, ended(20)).time == at(10));
  CHECK(judged(demand(Kind::Never, {}, "4"), course, ended(20)).time == at(10));
  CHECK(judged(demand(Kind::Eventually, window(10, 10), "0"), course, ended(20)).passed == false);
  CHECK(judged(demand(Kind::Final, {}, "0"), {{0, std::nan("")}}, ended(0)).passed == false);
}

TEST_CASE("eventually: once is enough, and the end of the interval is the failure") {
  const auto verdict = judged(demand(Kind::Eventually, {}, "4"), kFalls, ended(40));
  CHECK((verdict.passed == true && verdict.text == "4 V at 0.04 s" && !verdict.time));
  const auto late = judged(demand(Kind::Eventually, window(5, 35), "4"), kFalls, ended(40));
  CHECK((late.passed == false && late.time == at(35)));
  CHECK(late.text == "1 V; expected >= 4 V");
  CHECK(judged(demand(Kind::Eventually, {}, "5"), kFalls, ended(40)).time == at(40));
}

TEST_CASE("final: the value where the run ends") {
  const auto good = judged(demand(Kind::Final, {}, "4"), kFalls, ended(40));
  CHECK((good.passed == true && good.text == "4 V"));
  const auto bad = judged(demand(Kind::Final, {}, "5"), kFalls, ended(40));
  CHECK((bad.passed == false && bad.time == at(40) && bad.text == "4 V; expected >= 5 V"));
  CHECK_FALSE(judged(demand(Kind::Final, {}, "4"), kFalls, broke(40)).passed);
}

TEST_CASE("a run that breaks off leaves open what it did not come to") {
  CHECK_FALSE(judged(demand(Kind::Always, {}, "0"), kFalls, broke(40)).passed);
  CHECK_FALSE(judged(demand(Kind::Always, window(0, 41), "0"), kFalls, broke(40)).passed);
  CHECK(judged(demand(Kind::Always, window(0, 40), "0"), kFalls, broke(40)).passed == true);
  CHECK(judged(demand(Kind::Always, {}, "1.8"), kFalls, broke(40)).time == at(20));
  CHECK_FALSE(judged(demand(Kind::Eventually, {}, "5"), kFalls, broke(40)).passed);
  CHECK(judged(demand(Kind::Eventually, {}, "4"), kFalls, broke(40)).passed == true);
  CHECK(judged(demand(Kind::Always, {}, "0"), {}, broke(0)).text ==
        "the run ended at 0 s, before this was decided");
}

TEST_CASE("an interval that the run has not come to the end of is open, also if it ended well") {
  CHECK_FALSE(judged(demand(Kind::Always, window(0, 41), "0"), kFalls, ended(40)).passed);
  CHECK_FALSE(judged(demand(Kind::Eventually, window(0, 41), "5"), kFalls, ended(40)).passed);
  CHECK_FALSE(judged(demand(Kind::Always, window(41, {}), "0"), kFalls, ended(40)).passed);
}

TEST_CASE("between two communication points is known what holds at both") {
  CHECK(judged(demand(Kind::Always, window(11, 19), "1.5"), kFalls, ended(40)).passed == true);
  CHECK(judged(demand(Kind::Eventually, window(11, 19), "1.5"), kFalls, ended(40)).passed == true);
  const auto open = judged(demand(Kind::Always, window(11, 19), "1.8"), kFalls, ended(40));
  CHECK_FALSE(open.passed);
  CHECK(open.text == "there was no communication point in the interval");
}

TEST_CASE("margin of always: the least of the interval, also behind the first failure") {
  CHECK(margin_of(judged(demand(Kind::Always, {}, "0.25"), kFalls, ended(40))) ==
        "0.75 V at 0.03 s");
  const auto verdict = judged(demand(Kind::Always, {}, "1.75"), kFalls, ended(40));
  CHECK((verdict.time == at(20) && verdict.text == "1.5 V; expected >= 1.75 V"));
  CHECK(margin_of(verdict) == "-0.75 V at 0.03 s");
  CHECK(margin_of(judged(demand(Kind::Always, window(0, 20), "1.75"), kFalls, ended(40))) ==
        "-0.25 V at 0.02 s");
}

TEST_CASE("margin of never: the least distance from what it must not be") {
  CHECK(margin_of(judged(demand(Kind::Never, {}, "5"), kFalls, ended(40))) == "1 V at 0.04 s");
  CHECK(margin_of(judged(demand(Kind::Never, {}, "2.5"), kFalls, ended(40))) == "-1.5 V at 0.04 s");
  const auto touches = judged(demand(Kind::Never, {}, "4"), kFalls, ended(40));
  CHECK((touches.passed == false && margin_of(touches) == "0 V at 0.04 s"));
}

TEST_CASE("margin of eventually: the greatest of the interval, also behind what has passed it") {
  const auto verdict = judged(demand(Kind::Eventually, {}, "2.5"), kFalls, ended(40));
  CHECK(verdict.text == "3 V at 0 s");
  CHECK(margin_of(verdict) == "1.5 V at 0.04 s");
  CHECK(margin_of(judged(demand(Kind::Eventually, window(10, 30), "2.5"), kFalls, ended(40))) ==
        "-0.5 V at 0.01 s");
}

TEST_CASE("margin of final: that of the last value") {
  CHECK(margin_of(judged(demand(Kind::Final, {}, "3.5"), kFalls, ended(40))) == "0.5 V at 0.04 s");
  CHECK(margin_of(judged(demand(Kind::Final, {}, "5"), kFalls, ended(40))) == "-1 V at 0.04 s");
}

TEST_CASE("where there was no point in the interval, the margin is the lesser one beside it") {
  CHECK(margin_of(judged(demand(Kind::Always, window(11, 19), "1.25"), kFalls, ended(40))) ==
        "0.25 V at 0.02 s");
  CHECK(margin_of(judged(demand(Kind::Eventually, window(31, 39), "0.5"), kFalls, ended(40))) ==
        "0.5 V at 0.03 s");
}

TEST_CASE("what is undecided has no margin; what is decided has that of what was seen") {
  CHECK(margin_of(judged(demand(Kind::Always, {}, "0"), kFalls, broke(40))) == "none");
  CHECK(margin_of(judged(demand(Kind::Always, {}, "1.75"), kFalls, broke(40))) ==
        "-0.75 V at 0.03 s");
  CHECK(margin_of(judged(demand(Kind::Eventually, {}, "5"), kFalls, broke(40))) == "none");
}

TEST_CASE("NaN is infinitely far from what it should be") {
  const Course course{{0, 3}, {10, std::nan("")}, {20, 3}};
  CHECK(margin_of(judged(demand(Kind::Always, {}, "1"), course, ended(20))) == "-inf V at 0.01 s");
  CHECK(margin_of(judged(demand(Kind::Never, {}, "4"), course, ended(20))) == "-inf V at 0.01 s");
  CHECK(margin_of(judged(demand(Kind::Eventually, {}, "1"), course, ended(20))) == "2 V at 0 s");
}

TEST_CASE("the limits are part of the verdict, whatever it is") {
  const auto verdict = judged(demand(Kind::Always, window(5, {}), "1.8"), kFalls, broke(40));
  REQUIRE(verdict.limits);
  CHECK((verdict.limits->signal == "a.x" && verdict.limits->from == at(5) && !verdict.limits->to));
  REQUIRE(verdict.limits->limits.size() == 1);
  CHECK(verdict.limits->limits[0].name == "min");
}

TEST_CASE("texts are kept as they were") {
  ConditionText text;
  text.equals = "calm";
  const Definition definition{
      Kind::Always,
      "mood",
      "",
      {},
      {},
      SignalDemand{{0, 0}, 0, "a.s", "", Condition(variable(ValueType::String), text)}};
  SignalCheck check(definition);
  core::ValueBlock block(ValueType::String, 1);
  const core::Signal mood_signal{{0, 0}, &block, 0};
  check.attach({&mood_signal, 1});
  for (const auto& [time, mood] : {std::pair(0, "calm"), {1, "cross"}, {2, "calm"}}) {
    block.strings()[0] = mood;
    check.on_point(at(time));
  }
  const auto verdict = check.verdict(ended(2));
  CHECK(verdict.time == at(1));
  CHECK(verdict.text == "'cross'; expected = 'calm'");
  CHECK(margin_of(verdict) == "-1 at 0.001 s");
}
