// verify: what units of other tools do, what of it is a failure, and by which rule.
#include <cstdlib>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A check of a unit of these tests; see tests/test_units/fmi2/forgetter.c for the slips.
Outcome examine(const std::string& unit, const std::string& check, const char* slip = "0",
                const Arguments& further = {}) {
  Arguments arguments{"verify", test_fmu(unit).string(), "--check", check, "--instances", "60"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  ::setenv("STRIDE_TEST_SLIP", slip, 1);
  Outcome outcome = Workspace("").stride(arguments);
  ::unsetenv("STRIDE_TEST_SLIP");
  return outcome;
}

Outcome examine_forgetter(const std::string& check, const char* slip) {
  return examine("fmi2_forgetter", check, slip, {"--step", "0.05"});
}

void check_pass(const Outcome& outcome) {
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("1 passed, 0 failed"));
}

void check_failure(const Outcome& outcome, const std::string& text) {
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("FAILED") && Contains(text));
}

}  // namespace

TEST_CASE("a state that is restored with the inaccuracy of a solver passes, with a note") {
  check_pass(examine_forgetter("restore", "0"));
  const Outcome outcome = examine_forgetter("restore", "5");
  check_pass(outcome);
  CHECK_THAT(outcome.out, Contains("note") && Contains("all differences are within 1e-13"));
}

TEST_CASE("steps that are repeated with another last bit pass, with a note") {
  const Outcome exact = examine_forgetter("repetition", "0");
  check_pass(exact);
  CHECK_THAT(exact.out, Contains("each repeated twice: the same bits") && !Contains("note"));
  check_pass(examine_forgetter("restore", "10"));
  for (const char* slip : {"5", "10"}) {
    CAPTURE(slip);
    const Outcome outcome = examine_forgetter("repetition", slip);
    check_pass(outcome);
    CHECK_THAT(outcome.out, Contains("the same but for rounding") && Contains("note") &&
                                Contains("eachStep=\"true\""));
  }
  CHECK_THAT(examine_forgetter("repetition", "5").out,
             Contains("when the steps are repeated; all"));
  CHECK_THAT(examine_forgetter("repetition", "10").out,
             Contains("when the steps are repeated without reading values in between; all"));
}

TEST_CASE("a state that cannot be kept fails by the rule of the standard") {
  check_failure(examine_forgetter("restore", "1"), "fmi2GetFMUstate returned fmi2Error");
  check_failure(examine_forgetter("restore", "2"), "(FMI 2.0, 2.1.8)");
}

TEST_CASE("bytes that only an initialized instance takes, which leaves a pointer behind") {
  check_pass(examine_forgetter("serialization", "0"));
  const Outcome outcome = examine_forgetter("serialization", "6");
  check_failure(outcome, "fmi2DeSerializeFMUstate returned fmi2Error");
  CHECK_THAT(outcome.out, Contains("never initialised, another one goes on well") &&
                              Contains("(FMI 2.0, 2.1.8)") && !Contains("crashed"));
}

TEST_CASE("a unit that goes no further than its own stop time, or rounds a parameter, passes") {
  if (!kSanitized) check_pass(examine_forgetter("memory", "8"));
  check_pass(examine_forgetter("values", "9"));
}

TEST_CASE("a unit that can be instantiated once per process is instantiated once") {
  check_pass(examine("lying_only_once", "values"));
  if (!kSanitized) check_pass(examine("lying_only_once", "memory"));
}

TEST_CASE("a unit of FMI 1.0 is verified, too") {
  for (const char* check : {"load", "description", "values", "dependencies", "calls", "splitting",
                            "rejection", "reset", "instances", "determinism"}) {
    CAPTURE(check);
    check_pass(examine("fmi1_tank", check));
  }
  CHECK_THAT(examine("fmi1_tank", "restore").out, Contains("skipped"));
  CHECK_THAT(examine("fmi1_tank", "repetition").out, Contains("skipped"));
  const Outcome outcome = examine("fmi1_tank", "values", "0", {"--set", "mood=4"});
  check_failure(outcome, "fmiDoStep returned fmiError: it leaks");
}
