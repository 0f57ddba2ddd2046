#include "master/study/compare/outcomes.h"

#include <nlohmann/json.hpp>

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

const char* const kRun = R"({"outcome": "completed", "reached": 10.0,
  "verdicts": [{"component": "judge", "passed": true, "text": "3 of 3"}],
  "checks": [{"name": "warm", "passed": false, "text": "2 degC", "time": 1.5,
              "margin": {"value": -1.0}, "values": []}]})";

/// Of kRun and what it is with a text in place of another one.
Differences differences_with(const std::string& from, const std::string& to,
                             const Settings& settings = {}) {
  std::string text = kRun;
  text.replace(text.find(from), from.size(), to);
  const report::Json a = report::Json::parse(kRun);
  const report::Json b = report::Json::parse(text);
  return compare_outcomes({a, "run.json"}, {b, "other/run.json"}, settings);
}

}  // namespace

TEST_CASE("equal outcomes have no differences") { CHECK(differences_with("warm", "warm").empty()); }

TEST_CASE("another outcome is one, and has the time of the run that ended first") {
  const Differences differences =
      differences_with(R"("completed", "reached": 10.0)", R"("failed", "reached": 4.5)");
  REQUIRE(names_of(differences) == Names{"outcome outcome"});
  CHECK(differences[0].time == Time(4 * kSecond + kSecond / 2));
  CHECK(differences[0].b == "failed");
}

TEST_CASE("another end is one, but for the tolerance of time") {
  CHECK(names_of(differences_with("10.0", "10.5")) == Names{"outcome reached"});
  CHECK(differences_with("10.0", "10.5", {.time_tolerance = kSecond}).empty());
  CHECK(names_of(differences_with(R"("reached")", R"("error": "it broke", "reached")")) ==
        Names{"outcome error"});
}

TEST_CASE("a verdict that passed in one run alone is one") {
  const Differences differences = differences_with(R"("passed": true)", R"("passed": false)");
  REQUIRE(names_of(differences) == Names{"verdict judge"});
  CHECK(differences[0].a == "passed");
  CHECK(differences[0].b == "failed");
  CHECK(differences_with(R"("passed": true)", R"("passed": null)").at(0).b == "undecided");
}

TEST_CASE("a check that failed at another time is one, but for the tolerance of time") {
  const Differences differences = differences_with("1.5", "1.75");
  REQUIRE(names_of(differences) == Names{"check warm"});
  CHECK(differences[0].time == Time(kSecond + kSecond / 2));
  CHECK(differences[0].b == "failed at 1.75 s");
  CHECK(differences_with("1.5", "1.75", {.time_tolerance = kSecond / 4}).empty());
  CHECK(differences_with("1.5", "1.75", {.time_tolerance = kSecond / 5}).size() == 1);
}

TEST_CASE("words and margins contain values: they count if nothing is tolerated") {
  for (const auto& [from, to] : {std::pair("3 of 3", "2 of 2"), std::pair("2 degC", "2.1 degC"),
                                 std::pair("-1.0", "-1.5")}) {
    INFO(to);
    CHECK(differences_with(from, to).size() == 1);
    CHECK(differences_with(from, to, {.tolerance = {1e-9, 0}}).empty());
    CHECK(differences_with(from, to, {.tolerances = {{"x", {1, 0}, {}}}}).empty());
  }
  CHECK(differences_with("2 degC", "2.1 degC").at(0).a == "failed: 2 degC");
}

TEST_CASE("verdicts that one run has not are differences") {
  const Differences differences = differences_with("warm", "cold");
  REQUIRE(names_of(differences) == Names{"check cold", "check warm"});
  CHECK(differences[0].a == "none");
  CHECK(differences[0].b == "failed: 2 degC");
}

TEST_CASE("what is no list of verdicts is refused") {
  CHECK_THAT(error_of([] {
               differences_with(R"([{"component": "judge", "passed": true, "text": "3 of 3"}])",
                                "5");
             }),
             Contains("other/run.json: this is not what `stride run` writes: 'verdicts' is no "
                      "list"));
  CHECK_THAT(error_of([] {
               differences_with(R"([{"component": "judge", "passed": true, "text": "3 of 3"}])",
                                "[5]");
             }),
             Contains("'verdicts' is no list of objects"));
}

TEST_CASE("times that are none are as if there were none") {
  CHECK(differences_with("1.5", "1e300").size() == 1);
  CHECK(differences_with("10.0", R"("soon")").size() == 1);
}
