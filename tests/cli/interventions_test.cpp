// What a scenario and the command line change in the middle of a run.
#include <nlohmann/json.hpp>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Two low-passes in a row, the first of which has no source.
Workspace low_passes(const std::string& annotation = "") {
  return Workspace(Parts{component("a", "minimal.fmu") + component("b", "minimal.fmu"),
                         connection("a.y", "b.u"), annotation});
}

/// A ticker that ticks each 0.141 s, and who listens to it.
Workspace talkers(const std::string& annotation = "") {
  return Workspace(Parts{component("ticker", "ticker.fmu") + component("listener", "listener.fmu"),
                         connection("ticker.tick.clock", "listener.message.clock") +
                             connection("ticker.tick.number", "listener.message.number") +
                             connection("ticker.tick.picoseconds", "listener.message.picoseconds"),
                         annotation});
}

std::string events_of(const Workspace& workspace) { return workspace.result("events.csv"); }

}  // namespace

TEST_CASE("a scenario's interventions and those of the command line are made and recorded") {
  const Workspace workspace = low_passes(
      "<stride:Set variable='a.u' value='2' at='0.125'/>\n"
      "<stride:Force variable='b.u' from='0.25' until='0.5'/>\n");
  const Outcome outcome = workspace.run({"--quiet", "--force", "b.u=7@0.75.."});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(events_of(workspace), Contains("0.125,0,a,u,intervention,,set to 2\n") &&
                                       Contains("0.25,0,b,u,intervention,,held at ") &&
                                       Contains("0.5,0,b,u,intervention,,released\n") &&
                                       Contains("0.75,0,b,u,intervention,,forced to 7\n"));
}

TEST_CASE("without interventions a run is what it was, up to the first one") {
  const Workspace plain = low_passes();
  const Workspace changed = low_passes();
  REQUIRE(plain.run({"--quiet", "--set", "a.u=1"}).exit_code == 0);
  REQUIRE(changed.run({"--quiet", "--set", "a.u=1", "--force", "b.u=7@0.5.."}).exit_code == 0);
  const auto y = plain.signals().numbers("b.y");
  const auto changed_y = changed.signals().numbers("b.y");
  REQUIRE(y.size() == changed_y.size());
  const auto time = plain.signals().numbers("time");
  for (std::size_t i = 0; i < y.size(); ++i) {
    CAPTURE(time[i]);
    CHECK((y[i] == changed_y[i]) == (time[i] <= 0.5));
  }
}

TEST_CASE(
    "an intervention is the same in process, with a host, and with each unit's states saved") {
  const Arguments interventions{"--quiet",        "--set",    "a.u=1",       "--force",
                                "b.u@0.31..0.62", "--set-at", "a.u=3@0.4142"};
  const Workspace here = low_passes();
  const Workspace hosted = low_passes();
  const Workspace controlled = low_passes("<stride:Step policy='error-controlled'/>");
  REQUIRE(here.run(interventions).exit_code == 0);
  Arguments isolated = interventions;
  isolated.emplace_back("--isolate");
  REQUIRE(hosted.run(isolated).exit_code == 0);
  CHECK(here.result("signals.csv") == hosted.result("signals.csv"));
  REQUIRE(controlled.run(interventions).exit_code == 0);
  CHECK(controlled.signals().numbers("b.y").back() ==
        Approx(here.signals().numbers("b.y").back()).epsilon(0.01));
}

TEST_CASE("an intervention that makes no sense is an error before the run, with its line") {
  const Workspace workspace = low_passes("<stride:Set variable='b.u' value='2' at='0.125'/>\n");
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err,
             Contains("test.ssd:17: unit 'b', variable 'u': it cannot be set, since it "
                      "is fed by 'a.y'"));
  const Workspace late = low_passes("<stride:Force variable='b.u' value='2' from='5'/>\n");
  CHECK_THAT(late.run({"--quiet"}).err, Contains("5 s is outside of the run, from 0 s to 1 s"));
  CHECK(late.run({"--quiet", "--stop", "6"}).exit_code == 0);
}

TEST_CASE("an intervention behind an earlier stop time is left out") {
  const Workspace workspace = low_passes("<stride:Set variable='a.u' value='2' at='0.75'/>\n");
  CHECK(workspace.run({"--quiet", "--stop", "0.5"}).exit_code == 0);
  CHECK_THAT(events_of(workspace), !Contains("intervention"));
}

TEST_CASE("a unit with steps of one size that all make has no intervention in between") {
  const Workspace workspace(
      Parts{component("unit", "fmi2_rigid_stickler.fmu") + component("other", "minimal.fmu")});
  Arguments arguments{"--quiet", "--step", "0.1", "--stop", "0.6", "--set-at"};
  const auto run_with = [&](const std::string& intervention) {
    Arguments all = arguments;
    all.push_back(intervention);
    return workspace.run(all);
  };
  CHECK(run_with("other.u=1@0.25").exit_code == 0);
  arguments.insert(arguments.begin(), {"--coupling", "gauss-seidel"});  // all make the same steps
  CHECK(run_with("other.u=1@0.3").exit_code == 0);
  const Outcome outcome = run_with("other.u=1@0.25");
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err,
             Contains("unit 'unit': the unit takes steps of one size only, and none of "
                      "0.1 s ends at 0.25 s, the instant of an intervention on "
                      "'other.u'"));
}

TEST_CASE("check lists the interventions") {
  const Workspace workspace =
      low_passes("<stride:Force variable='b.u' from='0.25' until='0.5'/>\n");
  const Outcome outcome = workspace.stride({"check", "test.ssd", "--set-at", "a.u=2@0.125"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("\nInterventions\n"));
  CHECK_THAT(outcome.out, Contains("0.125             a.u       set           2"));
  CHECK_THAT(outcome.out, Contains("0.25        0.5  b.u       hold"));
}

TEST_CASE("messages are dropped and delayed by a scenario and by the command line") {
  const Workspace workspace = talkers(
      "<stride:Drop variable='listener.message.number' from='0.2' until='0.4'/>\n"
      "<stride:Delay variable='listener.message.clock' time='0.03' from='0.5'/>\n");
  const Arguments arguments{"--quiet", "--set", "ticker.period=0.1", "--stop", "0.75"};
  REQUIRE(workspace.run(arguments).exit_code == 0);
  const std::string events = events_of(workspace);
  CHECK_THAT(events, Contains("0.282842712475,1,listener,message.number,intervention,,dropped\n"));
  CHECK_THAT(events, !Contains("listener,message.number,received,2"));
  CHECK_THAT(events, Contains("0.424264068712,1,listener,message.number,received,3"));
  CHECK_THAT(events, Contains("0.565685424949,1,listener,message.clock,intervention,,delayed until "
                              "0.595685424949 s\n"));
  CHECK_THAT(events, Contains("0.595685424949,0,listener,message.number,received,4"));
  const Workspace other = talkers();
  Arguments options = arguments;
  for (const char* text : {"--drop", "listener.message.number@0.2..0.4", "--delay",
                           "listener.message.clock=0.03@0.5.."}) {
    options.emplace_back(text);
  }
  REQUIRE(other.run(options).exit_code == 0);
  CHECK(events_of(other) == events);
  const auto interventions = run_json(other)["interventions"];
  REQUIRE(interventions.size() == 2);
  CHECK(interventions[0]["kind"] == "drop");
  CHECK(interventions[1]["delay"] == 0.03);
}

TEST_CASE("a message that cannot be corrupted is an error before the run, with its line") {
  const Workspace workspace =
      talkers("<stride:Corrupt variable='listener.message.number' bits='2' from='0.2'/>\n");
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("unit 'listener', variable 'message.number': it cannot be "
                                   "disturbed, since it receives no Binary values"));
}
