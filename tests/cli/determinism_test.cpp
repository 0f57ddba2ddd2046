// The same scenario gives the same bytes.
#include "tests/cli/scenarios.h"

using namespace stride::tests;

TEST_CASE("two runs write the same results, on any number of threads") {
  const Workspace workspace(Parts{component("source", "not_a_number.fmu") +
                                      component("filter", "minimal.fmu") +
                                      component("stepper", "stepper.fmu"),
                                  connection("source.y", "filter.u")});
  const Arguments options{"--quiet",
                          "--set",
                          "source.nan_at=10",
                          "--set",
                          "filter.time_constant=0.3",
                          "--set",
                          "stepper.tick_at=0.125",
                          "--set",
                          "stepper.event_at=0.5"};
  const auto record = [&](const std::string& threads) {
    fs::remove_all(workspace / "out");
    Arguments all = options;
    all.insert(all.end(), {"--threads", threads});
    REQUIRE(workspace.run(all).exit_code == 0);
    std::vector<std::string> files;
    for (const char* file : {"signals.csv", "events.csv", "signals.vcd", "activity.csv"}) {
      files.push_back(workspace.result(file));
      CHECK(std::count(files.back().begin(), files.back().end(), '\n') > 1);
    }
    return files;
  };
  const auto first = record("1");
  for (const char* threads : {"1", "2", "64"}) {
    const auto second = record(threads);
    CHECK(first[0] == second[0]);
    CHECK(first[1] == second[1]);
    CHECK(first[2] == second[2]);
    CHECK(first[3] == second[3]);
  }
}
