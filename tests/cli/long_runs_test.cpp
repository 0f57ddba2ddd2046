// Runs of years, whose times need more than 64 bits of picoseconds.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using Words = std::vector<std::string>;

constexpr const char* kCentury = "3155760000";

Words times_of(const Workspace& workspace) {
  const Csv table = workspace.signals();
  Words times;
  for (std::size_t i = 0; i < table.size(); ++i) times.push_back(table.row(i)[0]);
  return times;
}

Outcome run_long(const Workspace& workspace, const Arguments& arguments) {
  Arguments all{"--quiet"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = workspace.run(all);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return outcome;
}

Parts ticker_and_listener() {
  return {component("ticker", "ticker.fmu") + component("listener", "listener.fmu"),
          connection("ticker.tick.clock", "listener.message.clock") +
              connection("ticker.tick.number", "listener.message.number") +
              connection("ticker.tick.picoseconds", "listener.message.picoseconds")};
}

}  // namespace

TEST_CASE("a century in steps of a day has a row for each, at its exact time") {
  const Workspace workspace(two_filters());
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments arguments{"--stop", kCentury, "--step", "86400", "--set", "first.u=1"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  CHECK(run_long(workspace, arguments).err == "");
  const Words times = times_of(workspace);
  REQUIRE(times.size() == 36526);
  CHECK(times[1] == "86400");
  CHECK(times[36524] == "3155673600");
  CHECK(times.back() == kCentury);
  CHECK(workspace.signals().numbers("second.y").back() == Approx(1));
  CHECK(nlohmann::json::parse(workspace.result("run.json"))["reached"] == 3155760000.0);
}

TEST_CASE("a run that begins after a century is that from 0 s on, to the picosecond") {
  const Workspace late(two_filters());
  const Workspace early(two_filters());
  const std::string step = GENERATE("0.25", "0.3333333333333333");
  run_long(early, {"--stop", "2", "--step", step, "--set", "first.u=1"});
  run_long(late,
           {"--start", kCentury, "--stop", "3155760002", "--step", step, "--set", "first.u=1"});
  const Words times = times_of(late);
  REQUIRE(times.size() == times_of(early).size());
  CHECK(times[1] == (step == "0.25" ? "3155760000.25" : "3155760000.333333333333"));
  CHECK(times.back() == "3155760002");
  for (const char* signal : {"first.y", "second.y"}) {
    const auto expected = early.signals().numbers(signal);
    const auto found = late.signals().numbers(signal);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]));
  }
}

TEST_CASE("components step with steps of their own in the last hours of a century") {
  const Workspace workspace(two_filters());
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments arguments{"--start", kCentury, "--stop", "3155767200",
                      "--step",  "3600",   "--step", "second=2400"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  run_long(workspace, arguments);
  CHECK(times_of(workspace) ==
        Words{kCentury, "3155762400", "3155763600", "3155764800", "3155767200"});
}

TEST_CASE("messages, interventions and checks are at exact times after a century") {
  Parts parts = ticker_and_listener();
  parts.components += component("filter", "minimal.fmu");
  parts.annotation =
      "<stride:Set variable='filter.u' value='1' at='3155760000.5'/>"
      "<stride:Checks>"
      "<stride:Always name='still' signal='filter.y' equals='0' to='3155760000.5'/>"
      "<stride:Eventually name='moves' signal='filter.y' above='0.1' from='3155760000.5' "
      "to='3155760002'/>"
      "</stride:Checks>";
  parts.experiment = "<ssd:DefaultExperiment startTime=\"3155760000\" stopTime=\"3155760002\"/>\n";
  const Workspace workspace(parts);
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments arguments;
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  run_long(workspace, arguments);
  const Csv events(workspace / "out/events.csv");
  std::size_t received = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto field = [&](const char* title) { return events.row(i)[events.column(title)]; };
    received += field("direction") == "received" && field("variable") == "message.number";
    CHECK_THAT(field("time"), Catch::Matchers::StartsWith("315576000"));
  }
  CHECK(received > 2);
}

TEST_CASE("a trace of a run of years has a time scale of 1 ns") {
  const Workspace workspace(two_filters());
  run_long(workspace, {"--stop", "31557600", "--step", "15778800", "--set", "first.u=1"});
  CHECK_THAT(workspace.result("signals.vcd"), Contains("$timescale 1 ns $end") &&
                                                  Contains("\n#15778800000000000\n") &&
                                                  Contains("\n#31557600000000000\n"));
}

TEST_CASE("the time scale of a trace is as coarse as 64 bits need it") {
  const Workspace workspace(two_filters());
  run_long(workspace, {"--stop", "1e10", "--step", "2.5e9", "--set", "first.u=1"});
  CHECK_THAT(workspace.result("signals.vcd"),
             Contains("$timescale 1 us $end") && Contains("\n#10000000000000000\n"));
}

TEST_CASE("steps may take years") {
  const Workspace workspace(two_filters());
  run_long(workspace, {"--stop", "1e9", "--step", "2.5e8"});
  CHECK(times_of(workspace) == Words{"0", "250000000", "500000000", "750000000", "1000000000"});
  run_long(workspace, {"--stop", "4e7", "--step", "4e7", "--step", "second=2e7"});
  CHECK(times_of(workspace) == Words{"0", "20000000", "40000000"});
}

TEST_CASE("steps that end at events, or at their maximum, go on for years") {
  const Workspace workspace(two_filters());
  run_long(workspace, {"--stop", "4e7", "--policy", "event-driven", "--max-step", "1e7"});
  CHECK(times_of(workspace) == Words{"0", "10000000", "20000000", "30000000", "40000000"});
}

TEST_CASE("a table has events at times that no double has") {
  const Workspace workspace(
      Parts{component("cycle", "cycle.csv"), "", "<stride:Record signals='cycle.*'/>"});
  workspace.scratch().write("cycle.csv",
                            "time,x: hold,y\n1700000000,1,0\n1700000000.1,3,10\n"
                            "1700000001.300000000001,4,20\n1700000002,5,30\n");
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments arguments{"--start", "1700000000", "--stop", "1700000002", "--step", "1"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  run_long(workspace, arguments);
  const Csv signals = workspace.signals();
  CHECK(signals.number(signals.row_at("1700000001"), signals.column("cycle.x")) == 3);
  CHECK(signals.number(signals.row_at("1700000002"), signals.column("cycle.x")) == 5);
}
