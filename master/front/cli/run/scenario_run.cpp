#include "master/front/cli/run/scenario_run.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/base/process/process_state.h"
#include "master/base/process/spare_files.h"
#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/command_line.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/end_note.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/run/branch_runs.h"
#include "master/front/cli/run/branches.h"
#include "master/front/cli/run/checkpoints.h"
#include "master/front/cli/run/idle_check.h"
#include "master/front/cli/run/live/live_server.h"
#include "master/front/cli/run/recorded_run.h"
#include "master/front/cli/run/result_folders.h"
#include "master/front/cli/run/summary.h"
#include "master/front/cli/run/test_report.h"
#include "master/observe/capture/capture.h"
#include "master/observe/checkpoint/journals.h"
#include "master/observe/recorders/copied_results.h"
#include "master/observe/recorders/provenance.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/study/results/checkpoint_states.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/provenance.h"
#include "master/study/results/report_page.h"
#include "master/system/plan/instances.h"
#include "master/system/plan/split_option.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::cli {
namespace {

/// The components of a scenario that can be read twice; none where it cannot be read, which is
/// reported later.
core::KnownNames component_names(const std::filesystem::path& scenario) {
  const bool is_pipe =
      core::path_exists(scenario) && !core::is_file(scenario) && !core::is_folder(scenario);
  core::KnownNames names;
  if (is_pipe) return names;
  try {
    const auto system = scenario::read_scenario(scenario, {scenario::find_unit}).system;
    for (const auto& component : system.components) names.add(component.name, true);
  } catch (const core::Error&) {
  }
  return names;
}

/// The files that the command line names, without what is no name: that is reported later.
std::vector<results::OutputPath> output_paths(const RunArguments& arguments) {
  std::vector<results::OutputPath> outputs;
  const bool is_unclear = std::ranges::any_of(arguments.captures, [](const std::string& text) {
    return std::ranges::count(text, '=') > 1;
  });
  core::KnownNames components;
  if (is_unclear) components = component_names(arguments.scenario.scenario);
  for (const std::string& text : arguments.captures) {
    const auto parts = scenario::split_component_file("--capture", text, components);
    if (parts) outputs.push_back({"--capture " + text, parts->file});
  }
  if (!arguments.junit.empty()) {
    outputs.push_back({"--junit " + arguments.junit.string(), arguments.junit});
  }
  return outputs;
}

std::vector<results::KeptPath> further_inputs(const RunArguments& arguments) {
  std::vector<results::KeptPath> inputs;
  if (arguments.branches.request) {
    inputs.push_back({arguments.branches.request->file, recorders::kBranchesFile});
  }
  for (const std::filesystem::path& file : arguments.scenario.parameter_files) {
    inputs.push_back({file, results::kParameters});
  }
  if (arguments.resumed) inputs.push_back({arguments.resumed->file, "the checkpoint"});
  return inputs;
}

/// Throws core::Error (Input), before anything is written. Returns what it has read of the
/// scenario, which may be nothing.
std::shared_ptr<ssp::Files> check_output_paths(const RunArguments& arguments) {
  const std::vector<results::OutputPath> outputs = output_paths(arguments);
  if (outputs.empty()) return nullptr;
  const std::filesystem::path folder = results_folder(arguments);
  for (const results::OutputPath& output : outputs) refuse_result_folders(folder, output);
  const results::ScenarioFiles files =
      results::files_of_scenario(arguments.scenario.scenario, arguments.scenario.swaps);
  results::refuse_kept_paths(outputs, files.inputs);
  results::refuse_kept_paths(outputs, further_inputs(arguments));
  results::refuse_kept_paths(outputs, results::kept_results(folder, files.results));
  results::refuse_shared_paths(outputs);
  return files.read;
}

recorders::ResultFiles chosen_files(const RunArguments& arguments,
                                    const scenario::RunPlan& loaded) {
  recorders::ResultFiles files = results::possible_files(loaded);
  if (arguments.no_trace) files.trace.clear();
  if (arguments.no_report) files.report.clear();
  for (const auto& [option, is_given] :
       {std::pair{"--open", arguments.open}, std::pair{"--live", !arguments.live.empty()}}) {
    if (!is_given || !files.report.empty()) continue;
    core::fail_input({}, fmt::format("{}: this run writes no report", option),
                     fmt::format("leave {} out, or let the run write its report", option));
  }
  return files;
}

core::RunOptions run_options(const RunArguments& arguments, const scenario::RunPlan& loaded,
                             const recorders::ResultFiles& files) {
  core::RunOptions options = results::options_for(loaded, files);
  if (!arguments.quiet) {
    const Summary summary(loaded.system(), loaded.options().recorded);
    options.watched.insert(options.watched.end(), summary.signals().begin(),
                           summary.signals().end());
  }
  options.threads.count = arguments.threads;
  if (options.threads.count > 1 && options.coupling == core::Coupling::GaussSeidel) {
    spdlog::warn(
        "--threads {}: with the coupling 'gauss-seidel' the units step one after another, on one "
        "thread",
        options.threads.count);
  }
  options.interrupted = &Interruption::flag();
  return options;
}

ProgressStyle progress_style(const RunArguments& arguments) {
  return arguments.progress.value_or(arguments.quiet ? ProgressStyle::None : ProgressStyle::Auto);
}

std::vector<capture::CaptureRequest> captures(const RunArguments& arguments,
                                              const core::KnownNames& components) {
  std::vector<capture::CaptureRequest> captures;
  for (const std::string& text : arguments.captures) {
    auto [component, file] =
        scenario::component_file("--capture", text, "COMPONENT=FILE", components);
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
void conclude_idle_check(const RunArguments& arguments, const scenario::RunPlan& loaded,
                         const core::RunStatistics& statistics,
                         const results::ResultsTarget& results) {
  if (arguments.full_run.empty()) return;
  if (arguments.promise_failure) core::fail_run({}, arguments.promise_failure->text);
  const std::string text = compare_with_full_run(loaded, statistics, results, arguments.full_run);
  if (!arguments.quiet) print_text("\n{}\n", text);
}

/// What contains how the run has ended. What fails after that, when libraries are unloaded, is
/// added.
struct Records {
  TestReport tests;
  std::optional<results::ResultsTarget> results{};  ///< once they are those of this run
  std::optional<std::string> failure{};             ///< of the run, which is not printed yet

  void add(const std::string& error);
};

/// The process ends, so nothing else prints the failure.
void Records::add(const std::string& error) {
  if (failure) print_error(*failure);
  if (results) results::add_error(*results, error);
  tests.write_late(error);
}

/// The results folder of a run, which no other run may use meanwhile. What an earlier run has left
/// there goes, unless this run goes on with it: of one that is resumed in another folder it goes
/// when the units are what they were at the checkpoint.
class ResultsOfRun {
 public:
  ResultsOfRun(const RunArguments& arguments, const scenario::RunPlan& loaded)
      : target_{results_folder(arguments), chosen_files(arguments, loaded)},
        names_(loaded.scenario().annotation.results),
        resumed_(arguments.resumed.get()),
        lock_(made(target_, loaded)) {
    if (resumed_ == nullptr) remove_earlier();
    if (goes_on()) return;
    recorders::clean_unit_folders(target_.folder, loaded.component_names());
    if (resumed_ != nullptr) recorders::copy_unit_files(resumed_->results, target_.folder);
  }

  results::ResultsTarget& target() { return target_; }

  /// Copies what the run goes on with elsewhere.
  void begin() const {
    if (resumed_ == nullptr) return;
    if (!goes_on()) {
      remove_earlier();
      recorders::copy_records(resumed_->results, target_.folder, target_.files);
    }
    for (const auto& [from, to] : resumed_->copies) {
      std::filesystem::create_directories(to.parent_path());
      core::copy_input(from, to);
    }
  }
  /// Behind begin(), where the run could not go on.
  void drop_copies() const {
    if (resumed_ == nullptr) return;
    if (!goes_on()) recorders::remove_results(target_.folder, names_);
    std::error_code ignored;
    for (const auto& [from, to] : resumed_->copies) std::filesystem::remove(to, ignored);
  }

 private:
  static const std::filesystem::path& made(const results::ResultsTarget& target,
                                           const scenario::RunPlan& loaded) {
    results::make_folder(target, loaded);
    return target.folder;
  }
  bool goes_on() const {
    return resumed_ != nullptr &&
           recorders::resolved(resumed_->results) == recorders::resolved(target_.folder);
  }
  void remove_earlier() const {
    recorders::remove_results(target_.folder, names_);
    remove_checkpoints(target_.folder);
  }

  results::ResultsTarget target_;
  recorders::ResultFiles names_;  ///< also of those that are not chosen
  const Resumption* resumed_;     ///< null: the run begins at its start
  recorders::ResultsLock lock_;
};

/// Whether its units may have to be rebuilt.
bool is_journaled(const RunArguments& arguments) {
  return arguments.checkpoints.are_wanted() || arguments.branches.request || arguments.resumed;
}

void require_time_in_run(const core::RunOptions& options, const Resumption& resumption) {
  const Time time = resumption.from.time;
  if (time >= options.start && time <= options.stop) return;
  core::fail_input(
      {.where = {resumption.file.string(), 0}},
      fmt::format("the checkpoint is at {} s, and the run is from {} s to {} s",
                  core::to_text(time), core::to_text(options.start), core::to_text(options.stop)),
      "choose a stop time behind the checkpoint, or an earlier checkpoint");
}

/// What was not there before would have had to begin in the part that is over.
void require_later_interventions(const core::RunOptions& options,
                                 const checkpoint::Checkpoint& from) {
  if (results::interventions_until(options, from.time) == from.interventions) return;
  core::fail_input({},
                   fmt::format("an intervention begins at or before {} s, where the run goes on",
                               core::to_text(from.time)),
                   "let it begin later, or resume the run from an earlier checkpoint");
}

/// Those with the branches of the run, and with the one that it is itself.
std::set<std::filesystem::path> branch_files(const RunArguments& arguments) {
  std::set<std::filesystem::path> files;
  if (arguments.branches.request) files.insert(arguments.branches.request->file);
  for (const scenario::BranchReference& branch : arguments.scenario.branches) {
    files.insert(branch.file);
  }
  return files;
}

/// A run that goes on has to agree with its checkpoint in that.
recorders::Provenance provenance(const RunArguments& arguments, const scenario::RunPlan& loaded) {
  core::FileDigests digests;
  recorders::Provenance made = results::provenance_of(loaded, command_line(), digests);
  for (const std::filesystem::path& file : branch_files(arguments)) {
    if (core::is_file(file)) {  // a pipe has been read
      made.sources.push_back(recorders::make_source(recorders::kBranchesFile, file, digests));
    }
  }
  if (!arguments.resumed) return made;
  const recorders::Provenance& before = arguments.resumed->from.provenance;
  results::require_same(before, made, arguments.resumed->file);
  require_time_in_run(loaded.options(), *arguments.resumed);
  require_later_interventions(loaded.options(), arguments.resumed->from);
  made.commands.insert(made.commands.begin(), before.commands.begin(), before.commands.end());
  return made;
}

/// The instances of a run, in the decorators that it needs.
class UnitsOfRun {
 public:
  UnitsOfRun(const RunArguments& arguments, const scenario::RunPlan& loaded,
             const std::filesystem::path& results, const core::RunOptions& options)
      : journals_(loaded.system()),
        instances_(scenario::instantiate(loaded, results, &Interruption::flag())) {
    if (is_journaled(arguments)) journals_.wrap(instances_, options.stop);
    if (!arguments.resumed) return;
    results::restore_units(journals_, arguments.resumed->from, arguments.resumed->file);
  }

  checkpoint::Journals& journals() { return journals_; }
  std::vector<std::unique_ptr<core::Unit>> take(capture::Capture& capture,
                                                core::RunOptions& options) {
    capture.wrap(instances_, options);
    return std::move(instances_);
  }

 private:
  checkpoint::Journals journals_;
  std::vector<std::unique_ptr<core::Unit>> instances_;
};

/// A run and all that belongs to it, from the first file that is read to the last that is written.
class ScenarioRun {
 public:
  ScenarioRun(const RunArguments& arguments, Records& records, LiveServer* live);

  void run(CrashGuard& guard);

 private:
  using Existing = core::OutputFile::Existing;

  bool is_resumed() const { return arguments_.resumed != nullptr; }
  Checkpoints::Span span() const;
  capture::Capture begin() const;
  checkpoint::Checkpoint take(Time now);
  void make_run();
  void print_branches() const;

  const RunArguments& arguments_;
  Records& records_;
  const Interruption interruption_;
  const scenario::RunPlan loaded_;
  const recorders::Provenance provenance_;
  Checkpoints checkpoints_;
  Branches branches_;
  ResultsOfRun results_;  // when all that may be wrong has been looked at
  core::RunOptions options_;
  const recorders::UnitFolders unit_folders_;
  const EndOfUnits end_{*loaded_.process()};
  UnitsOfRun units_;
  capture::Capture capture_;
  const RunDisplay display_;
  RecordedRun recorded_;
  BranchRuns branch_runs_;
};

ScenarioRun::ScenarioRun(const RunArguments& arguments, Records& records, LiveServer* live)
    : arguments_(arguments),
      records_(records),
      loaded_(arguments.scenario),
      provenance_(provenance(arguments, loaded_)),
      checkpoints_(arguments.checkpoints, span(), results_folder(arguments),
                   [this](Time now) { return take(now); }),
      branches_(read_branches(arguments, loaded_), arguments.branches, &Interruption::flag()),
      results_(arguments, loaded_),
      options_(run_options(arguments, loaded_, results_.target().files)),
      unit_folders_(results_.target().folder, loaded_.component_names()),
      units_(arguments, loaded_, results_.target().folder, options_),
      capture_(begin()),
      display_{progress_style(arguments), arguments.quiet, arguments.open, arguments.real_time,
               live},
      recorded_({loaded_, options_, provenance_, results_.target(), display_, capture_,
                 records.tests, arguments.resumed.get(), &checkpoints_},
                units_.take(capture_, options_)),
      branch_runs_({arguments, loaded_, results_.target(), recorded_,
                    [this](Time now) { return take(now); }}) {
  records.results = results_.target();
  if (arguments.checkpoints.are_wanted()) recorded_.set_control(checkpoints_);
  if (!arguments.branches.request) return;
  branch_runs_.connect(branches_);
  recorded_.set_control(branches_);
}

/// The files of the results, of which the first ones are those of captures.
capture::Capture ScenarioRun::begin() const {
  results_.begin();
  return {loaded_.system(), loaded_.scenario().name, options_,
          captures(arguments_, core::KnownNames(loaded_.component_names())),
          is_resumed() ? Existing::Kept : Existing::Emptied};
}

Checkpoints::Span ScenarioRun::span() const {
  const core::RunOptions& options = loaded_.options();
  return {options.start, is_resumed() ? arguments_.resumed->from.time : options.start,
          options.stop};
}

checkpoint::Checkpoint ScenarioRun::take(Time now) {
  checkpoint::Checkpoint taken{.provenance = provenance_,
                               .time = now,
                               .results = std::filesystem::absolute(results_.target().folder),
                               .interventions = results::interventions_until(options_, now)};
  units_.journals().add_to(taken);
  recorded_.add_to(taken);
  return taken;
}

/// The files are complete then; the units' libraries are unloaded later, and would not be while
/// there are threads that are newer than they.
struct EndOfLiveReport {
  LiveServer* server;
  ~EndOfLiveReport() {
    if (server != nullptr) server->end();
  }
};

void ScenarioRun::run(CrashGuard& guard) {
  const EndOfLiveReport end_of_live_report{display_.live};
  const CrashGuard::Scope scope(guard, [&](const std::string& error) {
    recorded_.abandon(error);
    print_branches();
  });
  try {
    make_run();
    checkpoints_.require_all();
    branches_.require_all();
    conclude_idle_check(arguments_, loaded_, recorded_.statistics(), results_.target());
  } catch (const core::TakenFileError& failure) {
    end_with(failure.what());
  } catch (const std::exception& failure) {
    records_.failure = failure.what();
    throw;
  }
}

void ScenarioRun::make_run() {
  try {
    if (is_resumed()) {
      recorded_.resume();
    } else {
      recorded_.run();
    }
  } catch (const std::exception&) {
    if (!recorded_.has_begun()) results_.drop_copies();
    print_branches();
    throw;
  }
  print_branches();
}

void ScenarioRun::print_branches() const {
  if (!arguments_.quiet) print_text("{}", branches_.text());
}

}  // namespace

void run_scenario(RunArguments arguments) {
  if (arguments.branches.request && arguments.checkpoints.are_wanted()) {
    core::fail_input({}, "--branch and checkpoints exclude each other",
                     "let one run write the checkpoint, and another one have the branches");
  }
  if (arguments.branches.request && !arguments.live.empty()) {
    core::fail_input({}, "--branch and --live exclude each other",
                     "look on at a run without branches");
  }
  arguments.scenario.files = check_output_paths(arguments);
  arguments.scenario.hosts.interrupted = &Interruption::flag();
  const core::ProcessState process;
  Records records{{arguments.junit, arguments.scenario.scenario}};
  if (core::is_file(arguments.junit))
    note_test_report(arguments.junit, arguments.scenario.scenario);
  std::optional<LiveServer> live;
  if (!arguments.live.empty()) {
    live.emplace(arguments.live == kAnyLivePort ? 0 : parse_live_port(arguments.live));
  }
  const core::SpareFiles spare;
  CrashGuard guard([&](const std::string& error) {
    core::SpareFiles::release_all();
    process.restore();
    records.add(error);
  });
  try {
    ScenarioRun(arguments, records, live ? &*live : nullptr).run(guard);
  } catch (const std::exception& failure) {
    process.restore();
    if (!records.tests.is_written()) records.tests.write(failure.what());
    throw;
  }
}

}  // namespace stride::cli
