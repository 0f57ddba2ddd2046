// What the units of a row were given, a step of all of them at a time.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_ROW_LOG_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_ROW_LOG_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "master/engine/port/unit.h"

namespace stride::core {

/// The last steps of a row, with the inputs of each unit, and the outputs that the units had where
/// the last of these steps began. To note a step is to copy some bytes; nothing is allocated.
///
/// Steps have positions, from 0 on; so many as there is room for are kept.
class RowLog {
 public:
  /// By unit, the blocks that a step exchanges: one of inputs and one of outputs at most, of the
  /// type Float64. They must outlive the log.
  explicit RowLog(std::span<const StepValues> units);

  /// That a step takes [byte].
  std::size_t step_size() const { return inputs_.size * sizeof(double) + sizeof(StepInterval); }
  /// To be called before steps are noted.
  void make_room(std::size_t steps);

  /// The position of the next step.
  std::uint64_t end() const { return end_; }
  /// Forgets all steps.
  void restart() { end_ = 0; }
  /// Notes the present inputs and outputs, before a step; returns it as it is noted.
  const StepInterval& begin_step(const StepInterval& interval, bool may_go_back_before);
  /// It has been made by all units that note it.
  void end_step() { ++end_; }

  /// Of a step that has begun.
  const StepInterval& interval(std::uint64_t position) const { return steps_[slot(position)]; }
  std::span<const double> inputs(std::size_t unit, std::uint64_t position) const;
  /// Where the last step began.
  std::span<const double> outputs_before(std::size_t unit) const;

 private:
  /// Numbers that are adjacent in memory.
  struct Run {
    const double* first;
    std::size_t size;
  };
  /// Those of all units, one behind the other.
  struct Numbers {
    std::vector<Run> runs;
    std::vector<std::size_t> firsts;  ///< by unit, and the end
    std::size_t size = 0;

    void add(std::span<const BoundValues> blocks);
    void copy_to(double* target) const;
    std::span<const double> of(std::size_t unit, const double* all) const {
      return {all + firsts[unit], firsts[unit + 1] - firsts[unit]};
    }
  };

  std::size_t slot(std::uint64_t position) const { return position & mask_; }

  Numbers inputs_, outputs_;
  std::size_t mask_ = 0;  ///< the room is a power of two [steps], less one
  std::uint64_t end_ = 0;
  std::vector<StepInterval> steps_;
  std::unique_ptr<double[]> given_;  ///< the inputs, by step
  std::unique_ptr<double[]> before_;
};

}  // namespace stride::core

#endif
