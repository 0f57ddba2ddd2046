// One communication step of all units, to an instant that all of them reach.
#ifndef STRIDE_MASTER_CORE_STEPPER_H
#define STRIDE_MASTER_CORE_STEPPER_H

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/core/run_options.h"
#include "master/core/statistics.h"
#include "master/core/step_inputs.h"
#include "master/core/step_order.h"
#include "master/core/system.h"
#include "master/core/thread_pool.h"
#include "master/core/unit.h"
#include "master/core/wall_clock.h"
#include "master/core/work_split.h"

namespace stride::core {

/// Steps the units, stage by stage as step_order() has them. All units of a stage are asked for the
/// same target. If one stops early or rejects the step, the target becomes where the first of them
/// stopped, or half the way; those that have gone further are rolled back and follow.
///
/// What a unit did is taken down in the step order, whichever thread did it and in whatever order,
/// so results, statistics and errors do not depend on the threads. Where several units of a stage
/// fail, the first one's error is thrown, when all threads have come to rest.
class Stepper {
 public:
  /// `units` in the order of system.components(). `inputs`: who sets them before each step; null
  /// if they stay what they are. Throws Error as step_order() does.
  Stepper(const System& system, std::span<const std::unique_ptr<Unit>> units,
          std::vector<UnitStatistics>& statistics, WallClock clock, const RunOptions& options,
          StepInputs* inputs = nullptr);

  const std::vector<StepPlace>& order() const { return order_; }

  /// Takes all units from `from` to `target`, or to the earlier instant, returned, at which one of
  /// them stopped. Throws Error (Run) naming the unit: a step shorter than the minimum was
  /// rejected, or a unit stopped when another could not go back.
  Time advance(Time from, Time target);

  /// Takes all units back to `from`, where the last advance() began. Their states must have been
  /// saved, as they are with an error-controlled step.
  void undo(Time from);

  /// How the unit's last accepted step ended.
  const StepResult& result(std::size_t component) const { return progress_[component].result; }

  /// Whether the last communication step was made on several threads.
  bool was_parallel() const { return was_parallel_; }

 private:
  enum class Outcome : std::uint8_t { Stood, Stepped, Rejected, TooFar, Failed };

  /// One unit in the present communication step. Written by the thread that steps it, and read when
  /// that has come to rest; a cache line of its own keeps the threads out of each other's way.
  struct alignas(64) Progress {
    StepResult result;      ///< where it stands, and how it came there
    bool is_saved = false;  ///< its state, at the instant where the communication step begins
    // in the present pass:
    Outcome outcome = Outcome::Stood;
    bool saved = false;
    bool rolled_back = false;
    std::chrono::nanoseconds time{};
    std::exception_ptr failure;
    bool is_consequence = false;  ///< of another unit's failure
  };
  using Stage = std::span<const StepPlace>;

  Time make_passes(Time from, Time target);
  Time step_all(Time from, Time target);
  Time step_stage(std::size_t stage, Time from, Time target);
  void step_on_threads(std::span<const WorkShare> shares, Time from, Time target);
  void step(const StepPlace& place, Time from, Time target) noexcept;
  Outcome go(const StepPlace& place, Progress& unit, Time from, Time target);
  void roll_back(std::size_t component, Time from);
  Time take_down(const StepPlace& place, Time from, Time target);
  void take_down_time(const StepPlace& place, std::chrono::nanoseconds time);
  [[noreturn]] void rethrow_failure(const StepPlace& first) const;
  void check_minimum(Time from, Time reached, Time target) const;
  [[noreturn]] void fail_size(const StepPlace& place, Time from, Time target) const;
  [[noreturn]] void fail_final(const StepPlace& ahead) const;
  WorkSplit::Plan plan(const RunOptions& options);
  ThreadPool& pool();

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  std::vector<UnitStatistics>& statistics_;
  WallClock clock_;
  WallClock step_clock_;  ///< measures where the work is to be split, too
  StepInputs* inputs_;
  Duration regular_;  ///< the size that units which cannot vary theirs must be given
  Duration minimum_;  ///< a shorter step than this is not asked for after a rejection
  std::vector<StepPlace> order_;
  std::vector<Stage> stages_;  ///< of order_
  std::vector<Progress> progress_;
  const StepPlace* stopped_ = nullptr;  ///< who stopped last
  Time stopped_at_{};
  std::uint64_t rejections_ = 0;  ///< in the present communication step
  WorkSplit split_;
  std::optional<ThreadPool> pool_;  ///< from when it is first needed
  bool was_parallel_ = false;
};

}  // namespace stride::core

#endif
