// One communication step of all units, to an instant that all of them reach.
#ifndef STRIDE_MASTER_CORE_STEPPER_H
#define STRIDE_MASTER_CORE_STEPPER_H

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/core/run_options.h"
#include "master/core/statistics.h"
#include "master/core/step_inputs.h"
#include "master/core/step_order.h"
#include "master/core/system.h"
#include "master/core/unit.h"
#include "master/core/wall_clock.h"

namespace stride::core {

/// Steps the units in the order of step_order(). If one stops early or rejects the step, the target
/// becomes where it stopped, or half the way; those that have gone further are rolled back and
/// follow.
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
  const StepResult& result(std::size_t component) const { return results_[component]; }

 private:
  void save(Time from);
  Time step_all(Time from, Time target);
  Time step_one(const StepPlace& place, Time from, Time target);
  bool step(const StepPlace& place, Time from, Time target);
  void roll_back(const StepPlace& place, Time from);
  Time shortened(const StepPlace& place, Time from, Time target);
  [[noreturn]] void fail_size(const StepPlace& place, Time from, Time target) const;
  [[noreturn]] void fail_final(const StepPlace& ahead) const;

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  std::vector<UnitStatistics>& statistics_;
  WallClock clock_;
  StepInputs* inputs_;
  Duration regular_;  ///< the size that units which cannot vary theirs must be given
  Duration minimum_;  ///< a shorter step than this is not asked for after a rejection
  std::vector<StepPlace> order_;
  std::vector<StepResult> results_;
  const StepPlace* stopped_ = nullptr;  ///< who stopped last
  std::uint64_t rejections_ = 0;        ///< in the present communication step
};

}  // namespace stride::core

#endif
