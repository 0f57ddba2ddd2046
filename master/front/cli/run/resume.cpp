// stride resume: a run goes on from a checkpoint.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/command_line.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/repeated_options.h"
#include "master/front/cli/run/checkpoints.h"
#include "master/front/cli/run/run_arguments.h"
#include "master/front/cli/run/scenario_run.h"
#include "master/observe/capture/capture.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/recorders/results_folder.h"
#include "master/system/plan/split_option.h"
#include "master/system/scenario/units/unit_path.h"
#include "master/system/settings/scenario_options.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct ResumeArguments {
  fs::path from;  ///< a checkpoint, or a results folder
  RunArguments changes;
};

/// The newest one in a results folder, or the file itself.
fs::path checkpoint_file(const fs::path& from) {
  if (from.empty()) {
    core::fail_input({}, "the name of the checkpoint is empty", "name a folder of results");
  }
  if (!core::path_exists(from)) {
    core::fail_input({.where = {from.string(), 0}}, "there is no such file or folder",
                     "name a checkpoint, or a folder of results");
  }
  if (!core::is_folder(from)) return fs::absolute(from);
  const std::vector<fs::path> found = checkpoints_in(from);
  if (!found.empty()) return fs::absolute(found.back());
  core::fail_input({.where = {from.string(), 0}},
                   "there is no checkpoint in this folder of results",
                   "let a run write some: stride run --checkpoint-every SECONDS");
}

/// Where the results are now: they may have been moved, with the checkpoint.
fs::path results_of(const Resumption& resumption) {
  const fs::path folder = resumption.file.parent_path();
  if (folder.filename() == kCheckpointsFolder) return folder.parent_path();
  return resumption.from.results;
}

/// Where the checkpoints are, which a run that begins there would remove.
void refuse_checkpoints_folder(const fs::path& out, const Resumption& resumption) {
  const fs::path folder = recorders::resolved(resumption.file.parent_path());
  if (recorders::resolved(out) != folder || folder.filename() != kCheckpointsFolder) return;
  core::fail_input({}, fmt::format("--out {}: this is the folder of the checkpoints", out.string()),
                   "name another folder");
}

void require_later_checkpoints(const CheckpointTimes& times, Time now) {
  for (const Time time : times.at) {
    if (time > now) continue;
    core::fail_input({}, fmt::format("--checkpoint {}: the run goes on at {} s",
                                     core::to_text(time), core::to_text(now)));
  }
}

/// Its files are named relative to it.
void enter_folder(const fs::path& folder, const fs::path& checkpoint) {
  std::error_code error;
  fs::current_path(folder, error);
  if (!error) return;
  core::fail_input(
      {.where = {checkpoint.string(), 0}},
      fmt::format("the run was started in the folder '{}': {}", folder.string(), error.message()),
      "put the folder with the scenario back to where it was");
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void add_interventions(scenario::ScenarioRequest& to, const scenario::ScenarioRequest& from) {
  append(to.set_at, from.set_at);
  append(to.forces, from.forces);
  append(to.drops, from.drops);
  append(to.delays, from.delays);
  append(to.corruptions, from.corruptions);
  append(to.branches, from.branches);
}

void add_times(CheckpointTimes& to, const CheckpointTimes& from) {
  append(to.at, from.at);
  if (from.every) to.every = from.every;
  to.on_signal = to.on_signal || from.on_signal;
}

/// What the run writes outside of its folder goes on in a copy there.
void go_elsewhere(RunArguments& arguments, Resumption& resumption, const fs::path& folder) {
  for (std::string& text : arguments.captures) {
    const auto parts = scenario::split_existing_file("--capture", text);
    if (!parts) continue;
    const fs::path copy =
        capture::copied_stimuli(folder) / capture::stimuli_file_name(parts->component);
    resumption.copies.emplace_back(parts->file, copy);
    text = fmt::format("{}={}", parts->component, copy.string());
  }
  arguments.junit.clear();
}

void change(RunArguments& arguments, Resumption& resumption, const RunArguments& changes) {
  if (!changes.scenario.stop.empty()) arguments.scenario.stop = changes.scenario.stop;
  if (!changes.scenario.signals.empty()) arguments.scenario.signals = changes.scenario.signals;
  resumption.has_other_signals = !changes.scenario.signals.empty();
  add_interventions(arguments.scenario, changes.scenario);
  add_times(arguments.checkpoints, changes.checkpoints);
  if (!changes.out.empty()) go_elsewhere(arguments, resumption, changes.out);
  if (!changes.junit.empty()) arguments.junit = changes.junit;
  if (changes.threads > 1) arguments.threads = changes.threads;
  arguments.progress = changes.progress;
  arguments.real_time = changes.real_time;
  arguments.quiet = changes.quiet;
  arguments.open = changes.open;
  arguments.live = changes.live;
}

void add_options(CLI::App& command, ResumeArguments& arguments) {
  RunArguments& changes = arguments.changes;
  command
      .add_option("FROM", arguments.from,
                  "A checkpoint, or a folder of results, of which the newest one is taken")
      ->required()
      ->type_name("");
  command.add_option("--stop", changes.scenario.stop, "Simulated time at which to end")
      ->type_name("SECONDS");
  command
      .add_option("--out,--output,-o", changes.out,
                  "Another results folder, which begins with a copy of those up to the checkpoint")
      ->type_name("FOLDER");
  command
      .add_option("--signals", changes.scenario.signals,
                  "Other variables to record, from the checkpoint on; with --out")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  settings::add_intervention_options(command, changes.scenario);
  command
      .add_option_function<std::string>(
          "--branch",
          [&](const std::string& text) {
            changes.scenario.branches.push_back(scenario::parse_branch_reference("--branch", text));
          },
          "The interventions of a branch, as files for 'stride run --branch' have them")
      ->type_name("FILE:NAME");
  add_checkpoint_options(command, changes.checkpoints);
  add_thread_and_junit_options(command, changes);
  add_display_options(command, changes);
}

/// Reads the words of an earlier command, with the options that `add` gives it.
template <class Add>
void parse_again(const recorders::Command& command, const fs::path& checkpoint, Add&& add) {
  CLI::App app("", "stride");
  for (const char* const name : {"run", "resume"}) {
    CLI::App* const subcommand = app.add_subcommand(name);
    subcommand->add_flag("--verbose");
    add(*subcommand);
  }
  app.add_flag("--verbose");
  app.require_subcommand(1);
  std::vector<std::string> words = with_repeated_options(command.words);
  std::ranges::reverse(words);  // as CLI11 takes them
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& mistake) {
    core::fail_input({.where = {checkpoint.string(), 0}},
                     fmt::format("the command line of its run cannot be used: {}", mistake.what()));
  }
}

void make_absolute(RunArguments& changes, const fs::path& folder) {
  for (fs::path* const path : {&changes.out, &changes.junit}) {
    if (!path->empty()) *path = folder / *path;
  }
  for (scenario::BranchReference& branch : changes.scenario.branches) {
    branch.file = folder / branch.file;
  }
}

/// What the run was asked for, with what was changed each time that it was resumed.
RunArguments arguments_of(Resumption& resumption) {
  const std::vector<recorders::Command>& commands = resumption.from.provenance.commands;
  if (commands.empty()) {
    core::fail_input({.where = {resumption.file.string(), 0}}, "it does not say what was run");
  }
  enter_folder(commands.front().folder, resumption.file);
  RunArguments arguments;
  parse_again(commands.front(), resumption.file,
              [&](CLI::App& command) { add_run_options(command, arguments); });
  arguments.branches = {};  // they have begun
  for (const recorders::Command& command : std::span(commands).subspan(1)) {
    ResumeArguments earlier;
    parse_again(command, resumption.file, [&](CLI::App& app) { add_options(app, earlier); });
    make_absolute(earlier.changes, command.folder);
    change(arguments, resumption, earlier.changes);
  }
  resumption.copies.clear();
  return arguments;
}

void resume(ResumeArguments given) {
  RunArguments& changes = given.changes;
  make_absolute(changes, fs::current_path());
  const auto resumption = std::make_shared<Resumption>();
  resumption->file = checkpoint_file(given.from);
  resumption->from = checkpoint::read_checkpoint(resumption->file);
  resumption->results = results_of(*resumption);
  require_later_checkpoints(changes.checkpoints, resumption->from.time);
  RunArguments arguments = arguments_of(*resumption);
  change(arguments, *resumption, changes);
  if (!core::is_folder(resumption->results)) {
    core::fail_input({.where = {resumption->file.string(), 0}},
                     fmt::format("the results that it goes on with are not in '{}'",
                                 resumption->results.string()),
                     "put the checkpoint back into their folder 'checkpoints'");
  }
  arguments.out = changes.out.empty() ? resumption->results : changes.out;
  refuse_checkpoints_folder(arguments.out, *resumption);
  const bool goes_elsewhere =
      recorders::resolved(arguments.out) != recorders::resolved(resumption->results);
  if (resumption->has_other_signals && !goes_elsewhere) {
    core::fail_input({}, "--signals: the file of the signals has others, up to the checkpoint",
                     "name another folder for results that begin at the checkpoint: --out FOLDER");
  }
  arguments.resumed = resumption;
  run_scenario(std::move(arguments));
}

}  // namespace

void add_resume(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("resume", "Go on with a run from a checkpoint, as if it had not ended");
  const auto arguments = std::make_shared<ResumeArguments>();
  add_options(*command, *arguments);
  command->callback([arguments] { resume(*arguments); });
}

}  // namespace stride::cli
