// stride run: a scenario from its start to its end.
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "master/base/child_process/child.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/run/idle_check.h"
#include "master/front/cli/run/promise_check.h"
#include "master/front/cli/run/scenario_run.h"

namespace stride::cli {
namespace {

/// The same run without idle skipping, which writes nothing but what is compared.
RunArguments full_run(const RunArguments& arguments) {
  RunArguments full = arguments;
  full.out = results_folder(arguments) / kFullRunFolder;
  full.scenario.no_idle_skip = true;
  full.scenario.max_skip.clear();
  full.full_run.clear();
  full.promise_failure.reset();
  full.captures.clear();
  full.junit.clear();
  full.real_time.reset();
  full.live.clear();
  full.scenario.film.clear();
  full.scenario.scene.clear();
  full.no_trace = full.no_report = full.quiet = true;
  full.open = full.check_idle = false;
  return full;
}

struct EndOfFork {
  ~EndOfFork() { end_guarding(); }
};

constexpr const char* kPromiseTest = "the test of the units' promises to be idle";
constexpr const char* kFullRun = "the run without idle skipping";

/// In a process of its own, so that units of different runs share nothing.
std::optional<ChildFailure> failure_in_child(const std::string& what,
                                             const std::function<void()>& work) {
  const Interruption interruption;
  const isolation::ChildOutcome outcome = isolation::run_in_child(
      [&]() -> std::string {
        const EndOfFork end;
        try {
          work();
        } catch (const core::Error& error) {
          if (error.kind() != core::Error::Kind::Input) throw;
          return error.what();
        }
        return {};
      },
      {.limit = {}, .interrupted = &Interruption::flag()});
  using End = isolation::ChildOutcome::End;
  if (outcome.end == End::Interrupted) core::fail_run({}, "interrupted during " + what);
  if (outcome.end == End::Threw) return ChildFailure{outcome.text};
  if (outcome.end != End::Answered) {
    return ChildFailure{outcome.printed.empty() ? "its process has ended" : outcome.printed};
  }
  if (outcome.text.empty()) return std::nullopt;
  return ChildFailure{outcome.text, true};
}

/// What has failed in the further runs of --check-idle, beyond what is `told` already.
void warn_of_further_runs(const RunArguments& arguments, std::string_view told) {
  const auto warn = [&](const char* what, const std::optional<ChildFailure>& failure) {
    if (!failure || failure->is_of_input) return;
    const bool is_told = told.find(failure->text) != std::string_view::npos;
    if (!is_told) spdlog::warn("{} has failed: {}", what, failure->text);
  };
  warn(kPromiseTest, arguments.promise_failure);
  warn(kFullRun, arguments.full_run_failure);
}

/// The results without idle skipping, and then the run itself, which tells of a wrong scenario.
void run_with_checks(RunArguments arguments) {
  if (!arguments.check_idle) return run_scenario(std::move(arguments));
  if (arguments.scenario.no_idle_skip) {
    core::fail_input({}, "--check-idle and --no-idle-skip contradict each other",
                     "use one of them");
  }
  if (arguments.checkpoints.are_wanted() || arguments.branches.request) {
    core::fail_input({}, "--check-idle cannot be combined with checkpoints and branches",
                     "use it in a run of its own");
  }
  if (!arguments.live.empty()) {
    core::fail_input({}, "--check-idle and --live exclude each other",
                     "look on at a run without --check-idle");
  }
  arguments.full_run = results_folder(arguments) / kFullRunFolder;
  arguments.promise_failure =
      failure_in_child(kPromiseTest, [&] { run_beside_twins(arguments.scenario); });
  if (!arguments.promise_failure || !arguments.promise_failure->is_of_input) {
    arguments.full_run_failure =
        failure_in_child(kFullRun, [&] { run_scenario(full_run(arguments)); });
  }
  try {
    run_scenario(arguments);
  } catch (const std::exception& error) {
    warn_of_further_runs(arguments, error.what());
    throw;
  }
  warn_of_further_runs(arguments, "");
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run a scenario and record what happens");
  const auto arguments = std::make_shared<RunArguments>();
  add_run_options(*command, *arguments);
  command->add_flag("--check-idle", arguments->check_idle,
                    "Test the units' promises to be idle, run the scenario without idle skipping, "
                    "too, and fail with the first difference that tolerances do not allow");
  command->callback([arguments] { run_with_checks(*arguments); });
}

}  // namespace stride::cli
