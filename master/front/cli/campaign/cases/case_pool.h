// Cases of a campaign that run at the same time, each in a process of its own.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_POOL_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_POOL_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "master/base/child_process/child.h"

namespace stride::cli {

class CasePool {
 public:
  struct Ended {
    std::uint64_t index = 0;
    isolation::ChildOutcome outcome;
    std::chrono::duration<double> wall_time{};  ///< of the process
    std::time_t began = 0;                      ///< when it did
  };

  /// `options` are those of each process.
  CasePool(std::size_t jobs, const isolation::ChildOptions& options)
      : jobs_(jobs), options_(options) {}

  bool is_full() const { return running_.size() >= jobs_; }
  bool is_empty() const { return running_.empty(); }

  /// Forks this process. Throws std::system_error if that is not possible.
  void start(std::uint64_t index, const std::function<std::string()>& work) {
    start(index, work, options_);
  }
  /// Likewise, with other options.
  void start(std::uint64_t index, const std::function<std::string()>& work,
             const isolation::ChildOptions& options);

  /// Starts it, and waits for its end: of a pool that is empty.
  Ended run_alone(std::uint64_t index, const std::function<std::string()>& work);

  /// From here on this process, which has no other children, adopts what loses its parent below it,
  /// and ends that when a case has ended in a bad way.
  void adopt_orphans();

  /// One that has ended; nothing if none does within the patience.
  std::optional<Ended> collect(std::chrono::milliseconds patience);

 private:
  using Clock = std::chrono::steady_clock;

  struct Running {
    std::uint64_t index;
    Clock::time_point begin;
    std::time_t began;
    isolation::Child child;
  };

  std::optional<Ended> take_ended();
  std::vector<const isolation::Child*> children() const;

  std::size_t jobs_;
  isolation::ChildOptions options_;
  std::list<Running> running_;
  bool adopts_orphans_ = false;
};

}  // namespace stride::cli

#endif
