#include "master/study/search/objective.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace stride::search;
using namespace stride::campaign;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

CaseVerdict verdict(const std::string& name, std::optional<bool> passed,
                    std::optional<double> margin = {}) {
  CaseVerdict made{.name = name, .kind = "always", .passed = passed, .text = "", .time = {}};
  if (margin) made.margin = CaseMargin{*margin, "V", 0};
  return made;
}

CaseResult result(std::vector<CaseVerdict> verdicts, Outcome outcome = Outcome::Passed) {
  CaseResult made;
  made.outcome = outcome;
  made.verdicts = std::move(verdicts);
  return made;
}

const CaseResult kNominal = result({verdict("voltage", true, 0.5), verdict("time", true, 0.001)});

}  // namespace

TEST_CASE("margins of different units are compared by their shares of the nominal ones") {
  const Objective all("", kNominal);
  CHECK(all.value(kNominal) == 1);
  CHECK(all.value(result({verdict("voltage", true, 0.4), verdict("time", true, 0.0005)})) == 0.5);
  CHECK(all.value(result({verdict("voltage", false, -1), verdict("time", true, 1)},
                         Outcome::Failed)) == -2);
  const Objective one("voltage", kNominal);
  CHECK(one.value(result({verdict("voltage", true, 0.4), verdict("time", true, 0.0005)})) == 0.8);
}

TEST_CASE("margins that are 0, infinite or unknown in the nominal case are not divided") {
  const Objective objective(
      "", result({verdict("a", true, 0.0), verdict("b", true, kInfinity), verdict("c", true)}));
  for (const char* name : {"a", "b", "c", "new"}) {
    CHECK(objective.value(result({verdict(name, true, 3)})) == 3);
  }
}

TEST_CASE("a check that is at its limit in the nominal case counts where it has failed") {
  const CaseResult nominal = result({verdict("count", true, 0.0), verdict("time", true, 0.5)});
  const Objective all("", nominal);
  CHECK(all.value(nominal) == 1);
  CHECK(all.value(result({verdict("count", false, -2), verdict("time", true, 0.5)},
                         Outcome::Failed)) == -2);
  Objective without_time("", nominal);
  without_time.disregard("time");
  for (const Objective& alone : {Objective("count", nominal), without_time}) {
    CHECK(alone.value(nominal) == 0);
    CHECK(alone.value(result({verdict("count", true, 3)})) == 3);
  }
}

TEST_CASE("the sign of the value is that of the verdict") {
  const Objective objective("", kNominal);
  CHECK(objective.value(result({verdict("voltage", false, 0.0)}, Outcome::Failed)) < 0);
  CHECK(objective.value(result({verdict("a unit", false)}, Outcome::Failed)) < 0);
  CHECK(objective.value(result({verdict("voltage", true, 0.0)})) >= 0);
  CHECK(objective.value(result({verdict("voltage", std::nullopt)})) == kInfinity);
  for (const Outcome outcome : {Outcome::Error, Outcome::Crashed, Outcome::TimedOut}) {
    CHECK(objective.value(result({}, outcome)) == -kInfinity);
    CHECK(failures_of(result({}, outcome)) == std::set<std::string>{name(outcome)});
  }
}

TEST_CASE("a failure that is disregarded is none") {
  Objective objective("", kNominal);
  const CaseResult failed =
      result({verdict("voltage", false, -1), verdict("time", true, 0.0005)}, Outcome::Failed);
  CHECK(objective.failures_in(failed) == std::set<std::string>{"voltage"});
  objective.disregard("voltage");
  CHECK(objective.failures_in(failed).empty());
  CHECK(objective.value(failed) == 0.5);
  CHECK_FALSE(objective.is_exhausted(kNominal));
  objective.disregard("time");
  CHECK(objective.is_exhausted(kNominal));
  CHECK(objective.value(failed) == kInfinity);
  objective.disregard("crashed");
  CHECK(objective.value(result({}, Outcome::Crashed)) == kInfinity);
}
