// SIGKILL and SIGSTOP for each process of a hosted unit in each phase of a run: the run ends, with
// a clear error where it cannot go on, and nothing is left.
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/cli/failures.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kSupervisor = "unit-supervisor";

/// The unit sleeps in a call of this phase for a second.
struct Phase {
  const char* what;
  const char* unit;
  Arguments options;
  const char* function;
  bool has_results;
};

const std::vector<Phase> kPhases{
    {"loading", "dozes_at_birth", {}, "fmi3InstantiateCoSimulation", false},
    {"initialization", "u", {"--set", "u.call=initialize"}, "fmi3ExitInitializationMode", true},
    {"step", "u", {"--set", "u.call=step", "--set", "u.at=0.5"}, "fmi3DoStep", true},
    {"termination", "u", {"--set", "u.call=terminate"}, "fmi3Terminate", true},
    {"end", "u", {"--set", "u.call=free"}, "fmi3FreeInstance", true},
};

struct Attack {
  const char* process;  ///< empty: that of the unit
  int signal;
  const char* error;  ///< empty: the run goes on
};

const std::vector<Attack> kAttacks{
    {"", SIGKILL, "its process was ended by signal 9 (SIGKILL) in "},
    {"", SIGSTOP, "it took longer than 3 s in "},
    {kSupervisor, SIGKILL, "something has ended its supervisor in "},
    {kSupervisor, SIGSTOP, ""},
};

/// The process that the attack is for, once the unit sleeps.
pid_t await_process(const Leftovers& run, const Workspace& workspace, Process& stride,
                    const Attack& attack, const Phase& phase) {
  const std::string name = attack.process;
  while (stride.is_running() && run.processes(phase.unit).empty()) std::this_thread::sleep_for(1ms);
  const std::vector<pid_t> found = run.processes(name.empty() ? phase.unit : name);
  REQUIRE(found.size() == 1);
  const fs::path sign = workspace / "out/units" / phase.unit / "dozes";
  while (stride.is_running() && !fs::exists(sign)) std::this_thread::sleep_for(1ms);
  return found.front();
}

Arguments run_command(const Phase& phase) {
  Arguments options{"--quiet", "--isolate", "--unit-timeout", "3"};
  if (!phase.options.empty()) options.insert(options.end(), {"--set", "u.fault=doze"});
  options.insert(options.end(), phase.options.begin(), phase.options.end());
  return stride_command(Workspace::run_arguments(options));
}

}  // namespace

TEST_CASE("a run ends well or with an error, whichever process is killed or stopped, and when") {
  for (const Phase& phase : kPhases) {
    for (const Attack& attack : kAttacks) {
      INFO(phase.what << ", signal " << attack.signal << " to '" << attack.process << "'");
      const Leftovers leftovers;
      const Workspace workspace(Parts{component(phase.unit, "faulty.fmu")});
      Process stride(run_command(phase), workspace.scratch().path());
      ::kill(await_process(leftovers, workspace, stride, attack, phase), attack.signal);
      const Outcome outcome = stride.wait();
      INFO(outcome.err);
      const std::string error = attack.error;
      CHECK(outcome.exit_code == (error.empty() ? 0 : 1));
      if (!error.empty()) {
        CHECK_THAT(outcome.err, Contains(std::string("unit '") + phase.unit + "'") &&
                                    Contains(error + phase.function));
      }
      CHECK(leftovers.all() == std::vector<std::string>{});
      CHECK(workspace.left_behind().empty());
      if (phase.has_results) {
        CHECK(run_json(workspace)["outcome"] == (error.empty() ? "completed" : "failed"));
      }
    }
  }
}

TEST_CASE("a run with snapshots ends, whichever process is killed or stopped") {
  const auto signal = GENERATE(SIGKILL, SIGSTOP);
  const auto which = GENERATE(as<std::string>(), "b: first", "b: last", kSupervisor);
  INFO("signal " << signal << " to " << which);
  const Leftovers leftovers;
  // two that may stop early and have no state: one of them is saved before each step
  const Workspace workspace(
      Parts{component("a", "early_without_state.fmu") + component("b", "early_without_state.fmu")});
  const Arguments options{"--quiet", "--unit-timeout", "4", "--stop", "1e6", "--no-trace"};
  Process stride(stride_command(Workspace::run_arguments(options)), workspace.scratch().path());
  await_first_results(stride, workspace);
  std::vector<pid_t> found;
  while (stride.is_running() && found.size() < (which[0] == 'b' ? 2 : 1)) {
    found = leftovers.processes(which.substr(0, which.find(':')));
  }
  REQUIRE_FALSE(found.empty());
  ::kill(which == "b: last" ? found.back() : found.front(), signal);
  std::this_thread::sleep_for(300ms);
  if (stride.is_running()) stride.send(SIGINT);  // nothing that it needs was hit
  const Outcome outcome = stride.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit '") || Contains("was interrupted"));
  CHECK(leftovers.all() == std::vector<std::string>{});
  CHECK(workspace.left_behind().empty());
}
