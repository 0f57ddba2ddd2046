#include "master/cli/scenario_run.h"

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/capture/capture.h"
#include "master/cli/crash_guard.h"
#include "master/cli/end_note.h"
#include "master/cli/idle_check.h"
#include "master/cli/interruption.h"
#include "master/cli/output.h"
#include "master/cli/output_paths.h"
#include "master/cli/recorded_run.h"
#include "master/cli/report_page.h"
#include "master/cli/summary.h"
#include "master/cli/test_report.h"
#include "master/recorders/results_folder.h"
#include "master/recorders/unit_folders.h"
#include "master/util/input_file.h"
#include "master/util/output_file.h"
#include "master/util/process/process_state.h"
#include "master/util/process/spare_files.h"

namespace stride::cli {
namespace {

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

}  // namespace

void run_scenario(RunArguments arguments) {
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

}  // namespace stride::cli
