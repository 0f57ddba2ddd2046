// A module of SystemC in runs of the program: its clocks, its rollback, and its end.
#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;

namespace {

/// 0.5 s in steps of 4 ms, which are none of the clocks'.
Parts chip_parts(const std::string& first, const std::string& second = "") {
  return {first + second, "", "<stride:Step size=\"0.004\"/>\n",
          "<ssd:DefaultExperiment stopTime=\"0.5\"/>\n"};
}
const std::string kTwoClocks = component("chip", "two_clocks.fmu");

void run_chip(const Workspace& workspace, Arguments options) {
  options.insert(options.begin(), "--quiet");
  const Outcome outcome = workspace.run(options);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

/// What the module holds after the edges up to and including 0.5 s, of which the slow one of 0.49 s
/// is at an instant of a fast one.
void check_chip_at_end(const Workspace& workspace) {
  const Csv signals = workspace.signals();
  const std::size_t end = signals.row_at("0.5");
  const auto value = [&](const char* name) { return signals.number(end, signals.column(name)); };
  CHECK(value("chip.fast_edges") == 51);
  CHECK(value("chip.slow_edges") == 36);
  int sum = 0;
  for (int ms = 0; ms <= 500; ms += 10) sum += (ms + 13) / 14;  // slow edges before this instant
  CHECK(value("chip.sum") == sum);
}

}  // namespace

TEST_CASE("a module with two clocks, in the process and in one of its own") {
  const Workspace workspace(chip_parts(kTwoClocks));
  run_chip(workspace, {});
  check_chip_at_end(workspace);
  const std::string signals = workspace.result("signals.csv");
  run_chip(workspace, {"--isolate"});
  CHECK(workspace.result("signals.csv") == signals);
}

TEST_CASE("a module is taken back by snapshots where another unit ends steps early") {
  const Workspace workspace(chip_parts(component("early", "early_without_state.fmu"), kTwoClocks));
  run_chip(workspace, {"--set", "early.instants=0.013 0.0701 0.0702 0.25 0.491 -1 -1 -1"});
  check_chip_at_end(workspace);
  CHECK_NOTHROW(workspace.signals().row_at("0.0701"));
  const auto run = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(run["units"][1]["host"]["snapshots"]["restored"] == 5);
}

TEST_CASE("sc_stop of a module ends a run well, at its instant") {
  const Workspace workspace(chip_parts(kTwoClocks, component("filter", "minimal.fmu")));
  const auto where = GENERATE(Arguments{}, Arguments{"--isolate"});
  Arguments options{"--set", "chip.last_edge=16"};
  options.insert(options.end(), where.begin(), where.end());
  run_chip(workspace, options);
  const Csv signals = workspace.signals();
  const std::size_t last = signals.size() - 1;
  CHECK(signals.row(last).front() == "0.15");
  CHECK(signals.number(last, signals.column("chip.fast_edges")) == 16);
  const auto run = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(run["outcome"] == "ended by a unit");
  CHECK(run["reached"] == 0.15);
}
