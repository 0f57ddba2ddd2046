// What a unit was given since its state was saved.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_STEP_LOG_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_STEP_LOG_H

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/values.h"
#include "master/engine/port/unit.h"

namespace stride::core {

/// The inputs and steps of a unit in Step Mode, in their order, so that they can be repeated.
class StepLog {
 public:
  struct Mark {
    std::size_t assignments = 0, bytes = 0, steps = 0;
  };

  void clear() { cut({}); }
  /// Drops what was added since.
  void cut(const Mark& mark) { used_ = mark; }
  Mark mark() const { return used_; }
  std::size_t steps() const { return used_.steps; }

  /// Has room for that many times what it holds, so that adding them allocates nothing.
  void reserve(std::size_t times);
  /// [byte]
  std::size_t size() const;

  /// Numbers only: other types are not logged.
  static bool can_add(const ValueBlock& values) { return element_size(values.type()) != 0; }
  static bool can_add(std::span<const BoundValues> inputs) {
    return std::ranges::all_of(inputs, [](const BoundValues& input) {
      return !input.float64s.empty() || can_add(*input.block);
    });
  }
  /// The references must outlive the log.
  void add_inputs(std::span<const ValueReference> references, const ValueBlock& values);
  void add_inputs(std::span<const BoundValues> inputs);
  void add_inputs(std::span<const ValueReference> references, std::span<const double> values);
  /// `outputs` were read after it; they must outlive the log.
  void add_step(const StepInterval& interval, std::span<const BoundValues> outputs,
                const StepResult& result);

  /// Of the last step, which is there.
  Time end() const { return steps_[used_.steps - 1].reached; }

  /// Sets the inputs behind the last step.
  void set_inputs(Unit& unit);
  /// Makes the unit do it all again; its outputs are read as they were. Calls after_last_step()
  /// when the last step has been made, before inputs that were set behind it. Returns whether each
  /// step ended as it did.
  template <class Action>
  bool repeat(Unit& unit, Action&& after_last_step);

 private:
  struct Assignment {
    std::span<const ValueReference> references;
    std::size_t first_byte = 0, size = 0;
    ValueType type{};
  };
  struct Step {
    StepInterval interval{Time{}, Time{}};
    std::span<const BoundValues> outputs;
    Time reached{};
    std::size_t assignments = 0;  ///< made up to its end
  };

  void add_assignment(std::span<const ValueReference> references, ValueType type, std::size_t size,
                      std::span<const std::byte> bytes);
  void assign(Unit& unit, std::size_t first, std::size_t last);
  ValueBlock& block(ValueType type, std::size_t size);
  static bool repeat(Unit& unit, const Step& step);

  Mark used_;  ///< of what follows; the rest is room for more
  std::vector<Assignment> assignments_;
  std::vector<std::byte> bytes_;
  std::vector<Step> steps_;
  std::vector<ValueBlock> blocks_;  ///< one of each type and size, to set inputs
};

template <class Action>
bool StepLog::repeat(Unit& unit, Action&& after_last_step) {
  bool is_same = true;
  std::size_t assigned = 0;
  for (const Step& step : std::span(steps_).first(used_.steps)) {
    assign(unit, assigned, step.assignments);
    assigned = step.assignments;
    is_same &= repeat(unit, step);
  }
  after_last_step();
  set_inputs(unit);
  return is_same;
}

}  // namespace stride::core

#endif
