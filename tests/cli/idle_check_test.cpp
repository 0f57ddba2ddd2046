// What stride verify and stride run --check-idle find out about promises to be idle.
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

Outcome verify_idle(const std::string& unit, const Arguments& further = {}) {
  Arguments arguments{"verify", unit, "--check", "idle"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return run_program(arguments);
}

/// A tank that reports each 50 ms, and keeps its promises as the parameter says.
Arguments tank(const std::string& promise) {
  return {"--set", "period=0.05", "--set", "announces=true", "--set", "promise=" + promise};
}

Workspace tank_scenario(const std::string& promise) {
  return Workspace(Parts{
      component("tank", "idler.fmu",
                "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
                "<ssv:ParameterSet xmlns:ssv=\"http://ssp-standard.org/SSP1/"
                "SystemStructureParameterValues\" version=\"1.0\" name=\"p\"><ssv:Parameters>"
                "<ssv:Parameter name=\"promise\"><ssv:Enumeration value=\"" +
                    promise +
                    "\"/></ssv:Parameter>"
                    "<ssv:Parameter name=\"period\"><ssv:Real value=\"0.05\"/></ssv:Parameter>"
                    "</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
                    "</ssd:ParameterBinding></ssd:ParameterBindings>"),
      "", "<stride:Step size=\"0.001\"/>"});
}

}  // namespace

TEST_CASE("verify: promises that are kept pass") {
  const Outcome honest = verify_idle("idler.fmu", tank("honest"));
  CHECK(honest.exit_code == 0);
  CHECK_THAT(honest.out,
             Contains("promises were kept, in 12 runs with random inputs") && Contains("1 passed"));
  CHECK_THAT(verify_idle("minimal.fmu").out, Contains("it never promises to be idle"));
}

TEST_CASE("verify: each way to break a promise is found") {
  struct Lie {
    std::string promise, seen;
  };
  const auto [promise, seen] = GENERATE(values<Lie>({
      {"rejects", "but rejects the step to there"},
      {"returns_early", "but returns early at "},
      {"ticks", "but has an event at "},
      {"drifts", "'level' is "},
      {"loses_time", "with skipping of idle time "},
  }));
  Arguments settings = tank(promise);
  if (promise == "drifts") settings.insert(settings.end(), {"--set", "rate=5"});
  const Outcome outcome = verify_idle("idler.fmu", settings);
  INFO(promise);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains(" FAILED ") && Contains(seen));
}

TEST_CASE("run --check-idle: the same with and without idle skipping") {
  const Workspace workspace = tank_scenario("honest");
  const Outcome outcome = workspace.run({"--check-idle"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("Idle skipping changes nothing but what tolerances allow") &&
                              Contains("agree with those in out/no_idle_skip"));
  CHECK(workspace.run({"--check-idle", "--quiet"}).out == "");
}

TEST_CASE("run --check-idle: the first difference has a name and a time") {
  const Workspace workspace = tank_scenario("loses_time");
  CHECK(workspace.run({"--quiet"}).exit_code == 0);
  const Outcome outcome = workspace.run({"--check-idle"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'tank', variable 'reports', at 0.05 s: ") &&
                              Contains("that is more than idle skipping may change"));
}

TEST_CASE("run --check-idle needs idle skipping") {
  const Workspace workspace = tank_scenario("honest");
  CHECK_THAT(input_error_of(workspace.run({"--check-idle", "--no-idle-skip"})),
             Contains("--check-idle and --no-idle-skip contradict each other"));
}
