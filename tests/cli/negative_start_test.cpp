// Runs that begin before 0 s.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using Words = std::vector<std::string>;

Words fields_of(const Csv& table, const std::string& title) {
  Words fields;
  for (std::size_t i = 0; i < table.size(); ++i) {
    fields.push_back(table.row(i)[table.column(title)]);
  }
  return fields;
}

Outcome run_from(const Workspace& workspace, const std::string& start, const std::string& stop,
                 const Arguments& further = {}) {
  Arguments arguments{"--start", start, "--stop", stop, "--quiet"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return workspace.run(arguments);
}

}  // namespace

TEST_CASE("a run that begins before 0 s is that from 0 s on, but for its times") {
  const Workspace before(two_filters());
  const Workspace at(two_filters());
  const std::string step = GENERATE("0.25", "0.3333333333333333");
  REQUIRE(run_from(at, "0", "2", {"--step", step, "--set", "first.u=1"}).exit_code == 0);
  const Outcome outcome = run_from(before, "-1", "1", {"--step", step, "--set", "first.u=1"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  for (const char* signal : {"first.y", "second.y"}) {
    const auto expected = at.signals().numbers(signal);
    const auto found = before.signals().numbers(signal);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]));
  }
  const Words times = fields_of(before.signals(), "time");
  CHECK(times == (step == "0.25"
                      ? Words{"-1", "-0.75", "-0.5", "-0.25", "0", "0.25", "0.5", "0.75", "1"}
                      : Words{"-1", "-0.666666666667", "-0.333333333333", "0", "0.333333333333",
                              "0.666666666667", "1"}));
  CHECK(nlohmann::json::parse(before.result("run.json"))["start"] == -1.0);
}

TEST_CASE("a trace whose run begins before 0 s has time stamps from its start on") {
  const Workspace workspace(two_filters());
  REQUIRE(run_from(workspace, "-1", "1", {"--step", "0.5", "--set", "first.u=1"}).exit_code == 0);
  CHECK_THAT(workspace.result("signals.vcd"),
             Contains("$timezero -1000000000000 $end\n$enddefinitions $end\n#0\n") &&
                 Contains("\n#2000000000000\n"));
}

TEST_CASE("the start time of a scenario may be before 0 s") {
  Parts parts = two_filters();
  parts.experiment = "<ssd:DefaultExperiment startTime=\"-0.5\" stopTime=\"-0.25\"/>\n";
  const Workspace workspace(parts);
  REQUIRE(workspace.run({"--step", "0.125", "--quiet"}).exit_code == 0);
  CHECK(fields_of(workspace.signals(), "time") == Words{"-0.5", "-0.375", "-0.25"});
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out, Contains("-0.5"));
}

TEST_CASE("interventions, messages and checks are at times before 0 s") {
  Parts parts{component("ticker", "ticker.fmu") + component("listener", "listener.fmu") +
                  component("filter", "minimal.fmu"),
              connection("ticker.tick.clock", "listener.message.clock") +
                  connection("ticker.tick.number", "listener.message.number") +
                  connection("ticker.tick.picoseconds", "listener.message.picoseconds"),
              "<stride:Set variable='filter.u' value='1' at='-0.5'/>"
              "<stride:Checks>"
              "<stride:Always name='still' signal='filter.y' equals='0' to='-0.5'/>"
              "<stride:Eventually name='moves' signal='filter.y' above='0.1' from='-0.5' to='0'/>"
              "</stride:Checks>"};
  const Workspace workspace(parts);
  const Outcome outcome =
      run_from(workspace, "-1", "0.5",
               {"--set-at", "filter.u=0@-0.25", "--drop", "listener.message.clock@-0.5..-0.25"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  const std::size_t y = signals.column("filter.y");
  CHECK(signals.number(signals.row_at("-0.5"), y) == 0);
  CHECK(signals.number(signals.row_at("-0.25"), y) > signals.number(signals.row_at("0"), y));
  const Csv events(workspace / "out/events.csv");
  std::size_t before = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto field = [&](const char* title) { return events.row(i)[events.column(title)]; };
    if (field("direction") != "received") continue;
    const double time = events.number(i, events.column("time"));
    CHECK_FALSE((-0.5 <= time && time < -0.25));
    before += time < -0.5;
    if (field("variable") != "message.picoseconds") continue;
    CHECK(std::stod(field("payload")) == Approx(1e12 * time));
  }
  CHECK(before > 0);
  CHECK_THAT(input_error_of(run_from(workspace, "-0.25", "0.5")),
             Contains("-0.5 s is outside of the run, from -0.25 s to"));
}

TEST_CASE("a table has values before 0 s, and its idle time is skipped") {
  const Workspace workspace(
      Parts{component("cycle", "cycle.csv"), "", "<stride:Record signals='cycle.*'/>"});
  workspace.scratch().write("cycle.csv", "time,gear: Int32,wanted\n-2,1,0\n-1,2,1\n1,3,3\n");
  REQUIRE(run_from(workspace, "-1.5", "1.5", {"--step", "0.5", "--max-skip", "10"}).exit_code == 0);
  const Csv signals = workspace.signals();
  CHECK(signals.number(signals.row_at("-1.5"), signals.column("cycle.gear")) == 1);
  CHECK(signals.number(signals.row_at("-1.5"), signals.column("cycle.wanted")) == 0.5);
  CHECK(signals.number(signals.row_at("-1"), signals.column("cycle.gear")) == 2);
  CHECK(signals.number(signals.row_at("1"), signals.column("cycle.gear")) == 3);
}

TEST_CASE("what a component received before 0 s is played to it") {
  const Workspace workspace(two_filters());
  REQUIRE(
      run_from(workspace, "-1", "0.5",
               {"--set", "first.u=1", "--signals", "second.y", "--capture", "second=stimuli.csv"})
          .exit_code == 0);
  REQUIRE(workspace.stride({"pack", "stimuli.csv", "-o", "player.fmu"}).exit_code == 0);
  Parts parts{component("player", "player.fmu") + component("second", "minimal.fmu"),
              connection("player.u", "second.u")};
  parts.experiment = "<ssd:DefaultExperiment startTime=\"-1\" stopTime=\"0.5\"/>\n";
  workspace.scratch().write("replay.ssd", scenario_text(parts));
  const Outcome outcome = workspace.stride(
      {"run", "replay.ssd", "--out", "replayed", "--quiet", "--signals", "second.y"});
  CHECK(outcome.err == "");
  CHECK(read(workspace / "replayed/signals.csv") == workspace.result("signals.csv"));
}

TEST_CASE("components step on grids that begin before 0 s, in processes of their own, too") {
  const Workspace workspace(two_filters());
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments further{"--step", "0.5", "--step", "second=0.75"};
  further.insert(further.end(), hosting.begin(), hosting.end());
  REQUIRE(run_from(workspace, "-1", "1", further).exit_code == 0);
  CHECK(fields_of(workspace.signals(), "time") == Words{"-1", "-0.5", "-0.25", "0", "0.5", "1"});
}
