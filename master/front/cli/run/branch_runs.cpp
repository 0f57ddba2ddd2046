#include "master/front/cli/run/branch_runs.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/observe/capture/capture.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/run_json.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/system/scenario/branches.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

/// Only one of them would be copied.
bool has_threads() {
  std::error_code error;
  const fs::directory_iterator tasks("/proc/self/task", error);
  return error || std::distance(begin(tasks), end(tasks)) > 1;
}

struct EndOfBranch {
  ~EndOfBranch() { end_guarding(); }
};

}  // namespace

std::vector<Branch> read_branches(const RunArguments& arguments, const scenario::RunPlan& loaded) {
  if (!arguments.branches.request) return {};
  const core::RunOptions& options = loaded.options();
  const auto& [time, file] = *arguments.branches.request;
  if (time < options.start || time >= options.stop) {
    core::fail_input(
        {}, fmt::format("--branch {}:{}: the run is from {} s to {} s", core::to_text(time),
                        file.string(), core::to_text(options.start), core::to_text(options.stop)));
  }
  std::vector<Branch> branches;
  for (const scenario::BranchDeclaration& declared : scenario::read_branches(file)) {
    branches.push_back(
        {declared.name, loaded.interventions_of_branch(declared.interventions, time)});
  }
  return branches;
}

/// A unit's file that is open, or whose path it knows, would be that of all forks.
bool can_fork(const scenario::RunPlan& loaded, const fs::path& results) {
  const auto is_hosted = [](const auto& hosting) { return hosting.has_value(); };
  return std::ranges::none_of(loaded.hostings(), is_hosted) && !has_threads() &&
         (results.empty() || !recorders::has_unit_files(results));
}

void BranchRuns::connect(Branches& branches) {
  branches.set_work(
      {.prepare = [this](Time now) { return prepare(now); },
       .rest = [this](const Branch& branch) { make_rest(branch); },
       .explain = [this](const Branch& branch,
                         const std::string& reason) { return explain(branch, reason); },
       .conclude = [this] { conclude(); }});
}

bool BranchRuns::prepare(Time now) {
  setup_.recorded.flush();
  fs::create_directories(setup_.results.folder / kBranchesFolder);
  const auto& request = setup_.arguments.scenario;
  const bool has_recording = !request.film.empty() || !request.scene.empty();
  if (!has_recording && can_fork(setup_.loaded, setup_.results.folder)) return false;
  checkpoint_ = fs::absolute(setup_.results.folder) / kBranchesFolder / "begin.zip";
  checkpoint::write_checkpoint(checkpoint_, setup_.take(now));
  return true;
}

void BranchRuns::conclude() const {
  std::error_code ignored;  // what remains of it disturbs nobody
  if (!checkpoint_.empty()) fs::remove(checkpoint_, ignored);
}

fs::path BranchRuns::folder(const Branch& branch) const {
  return fs::absolute(setup_.results.folder) / kBranchesFolder / branch.name;
}

void BranchRuns::make_rest(const Branch& branch) {
  if (!checkpoint_.empty()) resume(branch);
  const EndOfBranch end;
  const Interruption interruption;
  const CrashGuard guard([&](const std::string& error) { setup_.recorded.abandon(error); });
  setup_.results.folder = folder(branch);
  recorders::make_results_folder(setup_.results.folder);
  const recorders::ResultsLock lock(setup_.results.folder);
  recorders::remove_results(setup_.results.folder, setup_.loaded.scenario().annotation.results);
  setup_.recorded.run_rest(branch.interventions, capture::copied_stimuli(setup_.results.folder));
}

/// Its run.json has the error of a crash, and gets the reason where nothing could write it.
std::string BranchRuns::explain(const Branch& branch, const std::string& reason) const {
  const results::ResultsTarget results{folder(branch), setup_.results.files};
  const fs::path run_file = results.folder / results.files.statistics;
  if (results.files.statistics.empty() || !core::is_file(run_file)) return reason;
  std::string explained = reason;
  warn_of_failure([&] {
    explained = recorders::error_in(run_file).value_or(reason);
    results::add_error(results, reason);
  });
  return explained;
}

void BranchRuns::resume(const Branch& branch) const {
  const std::string out = folder(branch).string();
  const std::string which = fmt::format(
      "{}:{}", fs::absolute(setup_.arguments.branches.request->file).string(), branch.name);
  ::execl("/proc/self/exe", "stride", "resume", checkpoint_.c_str(), "--out", out.c_str(),
          "--branch", which.c_str(), "--quiet", "--progress", "none", nullptr);
  throw std::system_error(errno, std::generic_category(), "execl");
}

}  // namespace stride::cli
