// Runs that fail on the way.
#ifndef STRIDE_TESTS_CLI_FAILURES_H
#define STRIDE_TESTS_CLI_FAILURES_H

#include <chrono>
#include <cstdlib>
#include <string>
#include <system_error>
#include <thread>

#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

namespace stride::tests {

inline nlohmann::json run_json(const Workspace& workspace) {
  return nlohmann::json::parse(workspace.result("run.json"));
}

inline std::string last_time(const Workspace& workspace) {
  const Csv signals = workspace.signals();
  return signals.row(signals.size() - 1).front();
}

/// The message is on the standard error stream and in run.json, the results end at `last`.
inline std::string failure_of(const Workspace& workspace, const Arguments& options,
                              const std::string& last) {
  Arguments arguments{"--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out == "");
  CHECK(last_time(workspace) == last);
  const nlohmann::json run = run_json(workspace);
  CHECK(run["outcome"] == "failed");
  CHECK(run["reached"] == std::stod(last));
  CHECK_THAT(outcome.err,
             Catch::Matchers::Contains("stride: error: " + run["error"].get<std::string>()));
  CHECK(workspace.left_behind().empty());
  return run["error"];
}

/// A run that takes hours, once its first results are on the disk.
inline void await_first_results(Process& process, const Workspace& workspace) {
  using namespace std::chrono_literals;
  std::error_code none;
  while (process.is_running()) {
    const auto size = fs::file_size(workspace / "out/signals.csv", none);
    if (!none && size > 0) return;
    std::this_thread::sleep_for(1ms);
  }
  FAIL("the run ended by itself: " << process.wait().err);
}

/// `stride run` with these arguments, as a shell reads it.
inline std::string shell_command(const Arguments& further) {
  std::string command;
  for (const std::string& word : stride_command(Workspace::run_arguments(further))) {
    command += "'" + word + "' ";
  }
  return command;
}

/// What the units of tests/test_units/faults do in the runs that are started while it exists: the
/// fault, in the first call of this kind at this time [s] or later.
class FaultOrder {
 public:
  FaultOrder(const char* fault, const char* call, const char* at) {
    ::setenv("STRIDE_TEST_FAULT", fault, 1);
    ::setenv("STRIDE_TEST_CALL", call, 1);
    ::setenv("STRIDE_TEST_AT", at, 1);
  }
  ~FaultOrder() { ::unsetenv("STRIDE_TEST_FAULT"); }
  FaultOrder(const FaultOrder&) = delete;
  FaultOrder& operator=(const FaultOrder&) = delete;
};

}  // namespace stride::tests

#endif
