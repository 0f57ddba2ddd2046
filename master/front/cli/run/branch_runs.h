// The branches of a run that records, checks and shows.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_BRANCH_RUNS_H
#define STRIDE_MASTER_FRONT_CLI_RUN_BRANCH_RUNS_H

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "master/front/cli/run/branches.h"
#include "master/front/cli/run/checkpoints.h"
#include "master/front/cli/run/recorded_run.h"
#include "master/front/cli/run/run_arguments.h"
#include "master/system/plan/run_plan.h"

namespace stride::cli {

/// Those that the command line asks for; none if it does not. Throws core::Error (Input) for a file
/// that cannot be used, interventions that are none of this scenario, and an instant outside of the
/// run.
std::vector<Branch> read_branches(const RunArguments& arguments, const scenario::RunPlan& loaded);

/// Whether a fork of this process can go on with a run, beside it: not where units have processes
/// of their own or have written files, and not with several threads.
bool can_fork(const scenario::RunPlan& loaded, const std::filesystem::path& results);

/// What the branches go on with.
struct BranchSetup {
  const RunArguments& arguments;
  const scenario::RunPlan& loaded;
  results::ResultsTarget& results;  ///< in the process of a branch: of the branch
  RecordedRun& recorded;
  Checkpoints::Take take;
};

/// Makes the branches of a run: by a fork of its process, or where that cannot be copied (units in
/// processes of their own, threads, files of units) by resuming it from a checkpoint in a new one.
class BranchRuns {
 public:
  explicit BranchRuns(BranchSetup setup) : setup_(std::move(setup)) {}

  void connect(Branches& branches);

 private:
  bool prepare(Time now);
  void make_rest(const Branch& branch);
  std::string explain(const Branch& branch, const std::string& reason) const;
  void conclude() const;
  std::filesystem::path folder(const Branch& branch) const;
  [[noreturn]] void resume(const Branch& branch) const;

  BranchSetup setup_;
  std::filesystem::path checkpoint_;  ///< empty: the process is forked
};

}  // namespace stride::cli

#endif
