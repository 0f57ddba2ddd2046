// stride run: a scenario from its start to its end.
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/capture/capture.h"
#include "master/cli/commands.h"
#include "master/cli/crash_guard.h"
#include "master/cli/end_note.h"
#include "master/cli/idle_check.h"
#include "master/cli/interruption.h"
#include "master/cli/output.h"
#include "master/cli/output_paths.h"
#include "master/cli/promise_check.h"
#include "master/cli/recorded_run.h"
#include "master/cli/report_page.h"
#include "master/cli/scenario_options.h"
#include "master/cli/summary.h"
#include "master/cli/test_report.h"
#include "master/isolation/process/child.h"
#include "master/recorders/results_folder.h"
#include "master/recorders/unit_folders.h"
#include "master/scenario/loaded_scenario.h"
#include "master/util/input_file.h"
#include "master/util/output_file.h"
#include "master/util/process/process_state.h"
#include "master/util/process/spare_files.h"

namespace stride::cli {
namespace {

constexpr int kMostThreads = 1024;

/// Why work in a process of its own has failed.
struct ChildFailure {
  std::string text;
  bool is_of_input = false;  ///< what the user gave is wrong
};

struct RunArguments {
  scenario::ScenarioRequest scenario;
  std::filesystem::path out;
  std::vector<std::string> captures;  ///< "component=FILE"
  std::filesystem::path junit;        ///< empty: none
  std::size_t threads = 1;
  std::optional<ProgressStyle> progress;
  bool no_trace = false;
  bool no_report = false;
  bool open = false;  ///< the report
  bool quiet = false;
  bool check_idle = false;
  std::filesystem::path full_run{};  ///< the results without idle skipping to compare with
  std::optional<ChildFailure> promise_failure{}, full_run_failure{};
};

std::filesystem::path results_folder(const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return std::filesystem::path("results") / scenario::stem(arguments.scenario.scenario);
}

/// The files that the command line names, without what is no name: that is reported later.
std::vector<OutputPath> output_paths(const RunArguments& arguments) {
  std::vector<OutputPath> outputs;
  for (const std::string& text : arguments.captures) {
    const auto parts = scenario::split_component_file(text);
    if (parts) outputs.push_back({"--capture " + text, parts->file});
  }
  if (!arguments.junit.empty()) {
    outputs.push_back({"--junit " + arguments.junit.string(), arguments.junit});
  }
  return outputs;
}

/// Throws core::Error (Input), before anything is written. Returns what it has read of the
/// scenario, which may be nothing.
std::shared_ptr<ssp::Files> check_output_paths(const RunArguments& arguments) {
  const std::vector<OutputPath> outputs = output_paths(arguments);
  if (outputs.empty()) return nullptr;
  const std::filesystem::path folder = results_folder(arguments);
  for (const OutputPath& output : outputs) refuse_unit_folders(folder, output);
  const ScenarioFiles files =
      files_of_scenario(arguments.scenario.scenario, arguments.scenario.swaps);
  refuse_kept_paths(outputs, files.inputs);
  refuse_kept_paths(outputs, kept_results(folder, files.results));
  refuse_shared_paths(outputs);
  return files.read;
}

recorders::ResultFiles chosen_files(const RunArguments& arguments,
                                    const scenario::Scenario& scenario) {
  recorders::ResultFiles files = scenario.annotation.results;
  if (arguments.no_trace) files.trace.clear();
  if (arguments.no_report || !has_reports()) files.report.clear();
  if (arguments.open && files.report.empty()) {
    core::fail_input({}, "--open: this run writes no report",
                     "leave --open out, or let the run write its report");
  }
  return files;
}

/// Values that nothing records or shows are not read from the units.
core::RunOptions run_options(const RunArguments& arguments, const scenario::LoadedScenario& loaded,
                             const recorders::ResultFiles& files) {
  core::RunOptions options = loaded.options();
  if (files.signals.empty() && files.trace.empty()) options.recorded.clear();
  if (!arguments.quiet) {
    const Summary summary(loaded.system(), loaded.options().recorded);
    options.watched.insert(options.watched.end(), summary.signals().begin(),
                           summary.signals().end());
  }
  options.threads.count = arguments.threads;
  options.interrupted = &Interruption::flag();
  return options;
}

ProgressStyle progress_style(const RunArguments& arguments) {
  return arguments.progress.value_or(arguments.quiet ? ProgressStyle::None : ProgressStyle::Auto);
}

std::vector<capture::CaptureRequest> captures(const RunArguments& arguments) {
  std::vector<capture::CaptureRequest> captures;
  for (const std::string& text : arguments.captures) {
    auto [component, file] = scenario::component_file("--capture", text, "COMPONENT=FILE");
    captures.push_back({std::move(component), std::move(file)});
  }
  return captures;
}

/// The units end before it, and their libraries after it. What is done then needs the working
/// folder.
struct EndOfUnits {
  const core::ProcessState& process;
  ~EndOfUnits() {
    core::SpareFiles::release_all();
    process.restore();
    limit_end();
  }
};

/// The run with idle skipping has come to its end: tells of a unit that broke a promise, or else
/// compares the run with the one without.
void conclude_idle_check(const RunArguments& arguments, const scenario::LoadedScenario& loaded,
                         const core::RunStatistics& statistics, const ResultsTarget& results) {
  if (arguments.full_run.empty()) return;
  if (arguments.promise_failure) core::fail_run({}, arguments.promise_failure->text);
  const std::string text = compare_with_full_run(loaded, statistics, results, arguments.full_run);
  if (!arguments.quiet) print_text("\n{}\n", text);
}

/// What contains how the run has ended. What fails after that, when libraries are unloaded, is
/// added.
struct Records {
  TestReport tests;
  std::optional<ResultsTarget> results{};  ///< once they are those of this run
  std::optional<std::string> failure{};    ///< of the run, which is not printed yet

  void add(const std::string& error);
};

/// The process ends, so nothing else prints the failure.
void Records::add(const std::string& error) {
  if (failure) print_error(*failure);
  if (results) add_error(*results, error);
  tests.write_late(error);
}

void run(const RunArguments& arguments, Records& records, CrashGuard& guard) {
  const Interruption interruption;
  const scenario::LoadedScenario loaded(arguments.scenario);
  const recorders::ResultFiles files = chosen_files(arguments, loaded.scenario());
  const std::filesystem::path folder = results_folder(arguments);
  refuse_results(folder, loaded.scenario().annotation.results, inputs_of(loaded));
  recorders::make_results_folder(folder);
  recorders::check_name_lengths(folder, files);
  const recorders::ResultsLock lock(folder);
  recorders::remove_results(folder, loaded.scenario().annotation.results);
  records.results = {folder, files};
  const std::vector<std::string> components = loaded.component_names();
  recorders::clean_unit_folders(folder, components);
  core::RunOptions options = run_options(arguments, loaded, files);
  capture::Capture capture(loaded.system(), loaded.scenario().name, options, captures(arguments));
  const recorders::UnitFolders unit_folders(folder, components);
  const EndOfUnits end{loaded.process()};
  auto units = loaded.instantiate(folder, &Interruption::flag());
  capture.wrap(units, options);
  const RunDisplay display{progress_style(arguments), arguments.quiet, arguments.open};
  Recorders recorders(loaded.system(), *records.results);
  RecordedRun recorded(
      {loaded, options, *records.results, display, recorders, capture, records.tests},
      std::move(units));
  const CrashGuard::Scope scope(guard, [&](const std::string& error) { recorded.abandon(error); });
  try {
    recorded.run();
    conclude_idle_check(arguments, loaded, recorded.statistics(), *records.results);
  } catch (const core::TakenFileError& failure) {
    end_with(failure.what());
  } catch (const std::exception& failure) {
    records.failure = failure.what();
    throw;
  }
}

/// Whatever ends the command, the test report contains it.
void run_and_report(RunArguments arguments) {
  arguments.scenario.files = check_output_paths(arguments);
  const core::ProcessState process;
  Records records{{arguments.junit, arguments.scenario.scenario}};
  if (core::is_file(arguments.junit))
    note_test_report(arguments.junit, arguments.scenario.scenario);
  const core::SpareFiles spare;
  CrashGuard guard([&](const std::string& error) {
    core::SpareFiles::release_all();
    process.restore();
    records.add(error);
  });
  try {
    run(arguments, records, guard);
  } catch (const std::exception& failure) {
    process.restore();
    if (!records.tests.is_written()) records.tests.write(failure.what());
    throw;
  }
}

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
  full.scenario.film.clear();
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
  if (!arguments.check_idle) return run_and_report(std::move(arguments));
  if (arguments.scenario.no_idle_skip) {
    core::fail_input({}, "--check-idle and --no-idle-skip contradict each other",
                     "use one of them");
  }
  arguments.full_run = results_folder(arguments) / kFullRunFolder;
  arguments.promise_failure =
      failure_in_child(kPromiseTest, [&] { run_beside_twins(arguments.scenario); });
  if (!arguments.promise_failure || !arguments.promise_failure->is_of_input) {
    arguments.full_run_failure =
        failure_in_child(kFullRun, [&] { run_and_report(full_run(arguments)); });
  }
  try {
    run_and_report(arguments);
  } catch (const std::exception& error) {
    warn_of_further_runs(arguments, error.what());
    throw;
  }
  warn_of_further_runs(arguments, "");
}

void add_recording_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--out,--output,-o", arguments.out,
                  "Results folder; otherwise results/ and the scenario's name")
      ->type_name("FOLDER");
  command
      .add_option("--threads", arguments.threads,
                  "Step units on up to N threads where that is faster; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, kMostThreads));
  command
      .add_option("--capture", arguments.captures,
                  "Write all inputs of a component to a file that can be replayed to it alone; may "
                  "be given several times")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  // a flag, so that what follows a blank is the scenario; the value of a flag without one is
  // "true", kUnspecifiedFilmInterval
  command.add_flag("--film", arguments.scenario.film,
                   "Pictures of the MuJoCo worlds in units/COMPONENT/film/, every 0.1 s of "
                   "simulated time, or as in --film=SECONDS");
  command
      .add_option_function<std::string>(
          "--junit",
          [&](const std::string& file) {
            if (file.empty()) core::fail_input({}, "--junit: no file is named");
            arguments.junit = file;
          },
          "Write a test report in the XML of JUnit, with a test case for the run, each "
          "check and each unit's verdict")
      ->type_name("FILE");
  command.add_flag("--no-trace", arguments.no_trace, "Write no signals.vcd");
}

void add_display_options(CLI::App& command, RunArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--progress",
          [&](const std::string& text) { arguments.progress = read_progress_style(text); },
          "How to show progress: automatically (on a terminal a line that is rewritten, elsewhere "
          "a line now and then), in plain lines, in JSON objects for programs, or not at all")
      ->type_name("auto|plain|json|none");
  command.add_flag("--no-report", arguments.no_report, "Write no report.html");
  command.add_flag("--open", arguments.open, "Open the report in a browser when the run is over");
  command.add_flag("--quiet,-q", arguments.quiet, "Print nothing but warnings and errors");
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* command = app.add_subcommand("run", "Run a scenario and record what happens");
  const auto arguments = std::make_shared<RunArguments>();
  add_scenario_options(*command, arguments->scenario);
  add_recording_options(*command, *arguments);
  add_display_options(*command, *arguments);
  command->add_flag("--check-idle", arguments->check_idle,
                    "Test the units' promises to be idle, run the scenario without idle skipping, "
                    "too, and fail with the first difference that tolerances do not allow");
  command->callback([arguments] { run_with_checks(*arguments); });
}

}  // namespace stride::cli
