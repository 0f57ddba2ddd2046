// What stride verify and stride run --check-idle find out about promises to be idle.
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

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

/// A component whose reports come each `period` seconds.
std::string tank_component(const std::string& name, const std::string& promise,
                           const std::string& period = "0.05", const std::string& rate = "0.01") {
  const auto real = [](const std::string& parameter, const std::string& value) {
    return "<ssv:Parameter name=\"" + parameter + "\"><ssv:Real value=\"" + value +
           "\"/></ssv:Parameter>";
  };
  return component(name, "idler.fmu",
                   "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
                   "<ssv:ParameterSet xmlns:ssv=\"http://ssp-standard.org/SSP1/"
                   "SystemStructureParameterValues\" version=\"1.0\" name=\"p\"><ssv:Parameters>"
                   "<ssv:Parameter name=\"promise\"><ssv:Enumeration value=\"" +
                       promise + "\"/></ssv:Parameter>" + real("period", period) +
                       real("rate", rate) +
                       "</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>"
                       "</ssd:ParameterBinding></ssd:ParameterBindings>");
}

Workspace tank_scenario(const std::string& promise) {
  return Workspace(Parts{tank_component("tank", promise), "", "<stride:Step size=\"0.001\"/>"});
}

}  // namespace

TEST_CASE("verify: promises that are kept pass") {
  const Outcome honest = verify_idle("idler.fmu", tank("honest"));
  CHECK(honest.exit_code == 0);
  CHECK_THAT(honest.out,
             Contains("promises were kept, in 15 runs with random inputs") && Contains("1 passed"));
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

TEST_CASE("verify: a promise that is longer than a run has its own") {
  const auto tank_with = [](const std::string& promise, const std::string& period) {
    return verify_idle("idler.fmu", {"--set", "period=" + period, "--set", "announces=true",
                                     "--set", "promise=" + promise});
  };
  const Outcome liar = tank_with("loses_time", "1");
  CHECK(liar.exit_code == 1);
  CHECK_THAT(liar.out, Contains(" FAILED ") && Contains("the event report is at "));
  CHECK_THAT(tank_with("honest", "1").out, Contains("1 passed"));
  CHECK_THAT(tank_with("honest", "100").out, Contains("it promised to be idle for up to ") &&
                                                 Contains(" s, and was suspended for ") &&
                                                 Contains(" s at most; --stop makes longer runs"));
}

TEST_CASE("verify: what a long promise has lost is seen at an event after it") {
  const auto tank_with = [](const std::string& promise) {
    return verify_idle("idler.fmu", {"--set", "rate=0", "--set", "promise=" + promise});
  };
  const Outcome liar = tank_with("forgets");
  CHECK(liar.exit_code == 1);
  CHECK_THAT(liar.out, Contains("at 2.881 s 'age' is 0, and 2.88 without skipping"));
  const Outcome honest = tank_with("honest");
  CHECK(honest.exit_code == 0);
  CHECK_THAT(honest.out, Contains("it promised to be idle without an end, and was suspended for "
                                  "3.2 s at most; --stop makes longer runs"));
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
  CHECK_THAT(outcome.err,
             Contains("unit 'tank', variable 'report', at 0.05 s: it does not send 'report', "
                      "and an instance with the same inputs that is never suspended "
                      "does"));
}

TEST_CASE("run --check-idle: who breaks its promises is blamed, not who is connected to it") {
  const std::string promise = GENERATE("loses_time", "ticks");
  const Workspace workspace(Parts{
      tank_component("downstream", "honest", "0.2") + tank_component("liar", promise),
      connection("liar.level", "downstream.inflow") + connection("liar.report", "downstream.ask"),
      "<stride:Step size=\"0.001\"/>"});
  const Outcome outcome = workspace.run({"--check-idle", "--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, StartsWith("stride: error: unit 'liar', variable 'report"));
}

TEST_CASE("run --check-idle: the tolerances of others excuse nothing") {
  std::string tanks = tank_component("liar", "drifts", "0", "0.05");
  for (int i = 0; i < 200; ++i) {
    tanks += tank_component("tank" + std::to_string(i), "honest", "0");
  }
  const Workspace workspace(Parts{tanks, "", "<stride:Step size=\"0.01\"/>",
                                  "<ssd:DefaultExperiment stopTime=\"10\"/>\n"});
  const Outcome outcome = workspace.run({"--check-idle", "--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, StartsWith("stride: error: unit 'liar', variable 'level'") &&
                              Contains("; the tolerance is 0.001"));
}

TEST_CASE("run --check-idle: a recorded input has the tolerance of its source") {
  const Workspace workspace(
      Parts{tank_component("tank", "honest", "0", "1") + component("sink", "minimal.fmu"),
            connection("tank.level", "sink.u"),
            "<stride:Step size=\"0.001\"/><stride:Record signals=\"sink.u\"/>"
            "<stride:Tolerance variable=\"tank.level\" value=\"0.02\"/>"});
  CHECK(workspace.run({"--check-idle", "--quiet"}).err == "");
}

TEST_CASE("run --check-idle: a unit is not blamed for what it gets within tolerances") {
  const Workspace workspace(Parts{tank_component("tank", "honest", "0", "1") +
                                      component("sink", "minimal.fmu") +
                                      tank_component("other", "honest", "0"),
                                  connection("tank.level", "sink.u"),
                                  "<stride:Step size=\"0.001\"/><stride:Record signals=\"sink.y\"/>"
                                  "<stride:Tolerance variable=\"tank.level\" value=\"0.02\"/>"});
  const Outcome outcome = workspace.run({"--check-idle", "--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             StartsWith("stride: error: at 0.") &&
                 Contains(" s: the results with and without idle skipping differ by more than "
                          "skipping may change: 'sink.y' is ") &&
                 Contains("no unit was found to break its promises; what differs depends on "
                          "'tank', which was suspended"));
}

TEST_CASE("run --check-idle: a scenario that cannot be loaded is one error") {
  const Workspace workspace(
      Parts{tank_component("tank", "honest"), connection("tank.levl", "tank.inflow")});
  const std::string error = input_error_of(workspace.run({"--check-idle"}));
  CHECK(error == input_error_of(workspace.run()));
  CHECK_THAT(error, Contains("did you mean 'level'"));
}

TEST_CASE("run --check-idle: a run that fails is told of once") {
  const Workspace workspace(
      Parts{tank_component("tank", "honest") + component("thrower", "thrower.fmu"), "",
            "<stride:Step size=\"0.1\"/>"});
  const Arguments fails{"--quiet", "--set", "thrower.throw_at=0.5"};
  const Outcome plain = workspace.run(fails);
  CHECK(plain.exit_code == 1);
  const Outcome checked =
      workspace.run({"--check-idle", "--quiet", "--set", "thrower.throw_at=0.5"});
  CHECK(checked.exit_code == 1);
  CHECK(checked.err == plain.err);
}

TEST_CASE("run --check-idle says that it has tested nothing") {
  const Workspace workspace = tank_scenario("loses_time");
  const Outcome outcome = workspace.run({"--check-idle", "--coupling", "gauss-seidel"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("--check-idle has tested nothing: no unit can be suspended"));
}

TEST_CASE("run --check-idle needs idle skipping") {
  const Workspace workspace = tank_scenario("honest");
  CHECK_THAT(input_error_of(workspace.run({"--check-idle", "--no-idle-skip"})),
             Contains("--check-idle and --no-idle-skip contradict each other"));
}
