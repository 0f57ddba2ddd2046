// stride run --branch: several futures of a run, whose common part is simulated once.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_BRANCHES_H
#define STRIDE_MASTER_FRONT_CLI_RUN_BRANCHES_H

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/base/child_process/child.h"
#include "master/engine/run/context/intervention.h"
#include "master/engine/run/run_control.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// What the command line asks for.
struct BranchRequest {
  Time time{};
  std::filesystem::path file;  ///< with <stride:Branches>
};

struct BranchOptions {
  std::optional<BranchRequest> request{};
  std::size_t jobs = 0;  ///< processes at the same time; 0: as many as there are cores
};

/// --branch and --jobs. `options` must outlive the command line.
void add_branch_options(CLI::App& command, BranchOptions& options);

/// The folder in that of the results; each branch has a folder of its name there.
inline constexpr const char* kBranchesFolder = "branches";

/// A future of a run: what is changed in it.
struct Branch {
  std::string name;
  std::vector<core::Intervention> interventions;
};

/// Forks the run for each branch, before the step that would reach the instant at which they begin.
/// The run itself goes on when they have ended: what becomes of it, becomes of it alone.
class Branches final : public core::RunControl {
 public:
  /// The rest of a branch, in a process of its own. What it throws, or what ends the process, is
  /// the failure of the branch.
  using Rest = std::function<void(const Branch& branch)>;

  struct Work {
    /// Called once, before the first branch begins. Returns whether branches go on as programs of
    /// their own, whose good end is an exit with code 0.
    std::function<bool(Time now)> prepare;
    Rest rest;
    /// Why a branch has failed that could not say it itself. `reason`: what became of its process.
    std::function<std::string(const Branch& branch, const std::string& reason)> explain;
    std::function<void()> conclude;  ///< likewise, when the last one has ended
  };

  /// `interrupted`: ends the branches when it is no longer 0.
  Branches(std::vector<Branch> branches, const BranchOptions& options,
           const volatile std::sig_atomic_t* interrupted);
  /// Before the run.
  void set_work(Work work) { work_ = std::move(work); }

  std::optional<core::Pause> next(Time now) override;
  void on_pause(Time now) override;

  /// For people: what became of each.
  std::string text() const;
  /// Throws core::Error (Run) if one has failed, or the run ended before they began.
  void require_all() const;

 private:
  struct Running {
    std::size_t branch;
    isolation::Child child;
  };

  bool collect(std::chrono::milliseconds patience);
  void note_end(std::size_t branch, const isolation::ChildOutcome& outcome);

  Time time_;
  std::vector<Branch> branches_;
  std::size_t jobs_;
  Work work_;
  const volatile std::sig_atomic_t* interrupted_;
  bool has_forked_ = false;
  bool are_programs_ = false;
  std::list<Running> running_;
  std::vector<std::optional<std::string>> failures_;  ///< by branch; empty: good
};

}  // namespace stride::cli

#endif
