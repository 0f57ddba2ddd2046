// Units whose functions for their state are broken: they run where no step is undone, and else are
// named, with what can be done.
#include <cstdlib>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kStateHint =
    "hint: <stride:StateSaving components=\"forgetter\" allowed=\"false\"/> lets it run without";

/// A forgetter behind another unit: fmi2_turner rejects a step at 0.25 s, fmi2_relaxation might.
Workspace behind(const std::string& unit, const std::string& annotation = "") {
  const std::string output = unit == "fmi2_turner.fmu" ? "first.y" : "first.x";
  return Workspace(Parts{component("first", unit) + component("forgetter", "fmi2_forgetter.fmu"),
                         connection(output, "forgetter.u"), annotation});
}

/// See tests/test_units/fmi2/forgetter.c.
Outcome run_with_slip(const Workspace& workspace, const char* slip, const Arguments& further = {}) {
  Arguments arguments{"--quiet", "--step", "0.1"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  ::setenv("STRIDE_TEST_SLIP", slip, 1);
  Outcome outcome = workspace.run(arguments);
  ::unsetenv("STRIDE_TEST_SLIP");
  INFO(outcome.err);
  return outcome;
}

void check_named(const char* slip, const std::string& text, const Arguments& further = {}) {
  CAPTURE(slip);
  const Outcome outcome = run_with_slip(behind("fmi2_turner.fmu"), slip, further);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'forgetter'") && Contains(text) && Contains(kStateHint));
}

}  // namespace

TEST_CASE("a unit that cannot save its state runs where it is not needed, with a warning") {
  const Workspace workspace = behind("fmi2_relaxation.fmu");
  REQUIRE(run_with_slip(workspace, "0").exit_code == 0);
  const std::string expected = workspace.result("signals.csv");
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  const Outcome outcome = run_with_slip(workspace, "1", hosting);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.result("signals.csv") == expected);
  const std::string warning = "unit 'forgetter': fmi2GetFMUstate returned fmi2Error";
  CHECK_THAT(outcome.err, Contains(warning) && Contains("its state is not saved any more") &&
                              Contains("<stride:StateSaving components=\"forgetter\""));
  CHECK(outcome.err.find(warning) == outcome.err.rfind(warning));
}

TEST_CASE("where a step is undone, a unit with a broken state is named, with what can be done") {
  check_named("1", "its state could not be saved: fmi2GetFMUstate returned fmi2Error");
  check_named("2", "fmi2SetFMUstate returned fmi2Error");
  check_named("3", "fmi2DoStep returned fmi2Error: its time is 0.3 s");
}

TEST_CASE("a crash in a function for the state is one that can be prevented") {
  if (!kSanitized) check_named("7", "SIGSEGV) ends stride in fmi2GetFMUstate");
  check_named("7", "its process was ended by signal 11 (SIGSEGV) in fmi2GetFMUstate",
              {"--isolate"});
}

TEST_CASE("without its own functions for its state it follows the others") {
  const Workspace workspace =
      behind("fmi2_turner.fmu", "<stride:StateSaving components=\"forgetter\" allowed=\"false\"/>");
  for (const char* slip : {"1", "2", "3", "7"})
    CHECK(run_with_slip(workspace, slip).exit_code == 0);
}

TEST_CASE("a state that is a null pointer is one, with a warning where it is restored") {
  const Workspace workspace = behind("fmi2_turner.fmu");
  REQUIRE(run_with_slip(workspace, "0").exit_code == 0);
  const std::string expected = workspace.result("signals.csv");
  const Outcome outcome = run_with_slip(workspace, "4");
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.result("signals.csv") == expected);
  const std::string warning = "unit 'forgetter': fmi2GetFMUstate returned fmi2OK and no state";
  CHECK_THAT(outcome.err,
             Contains(warning) && Contains("<stride:StateSaving components=\"forgetter\""));
  CHECK(outcome.err.find(warning) == outcome.err.rfind(warning));
  CHECK(run_with_slip(behind("fmi2_relaxation.fmu"), "4").err == "");
}
