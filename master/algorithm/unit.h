// The port behind which a unit lives, in this process or in another.
#ifndef STRIDE_MASTER_ALGORITHM_UNIT_H
#define STRIDE_MASTER_ALGORITHM_UNIT_H

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/capability.h"
#include "master/model/description.h"
#include "master/model/values.h"

namespace stride::core {

/// A communication step, with its ends as units take them, too.
struct StepInterval {
  StepInterval(Time step_from, Time step_to)
      : StepInterval(step_from, to_seconds(step_from), step_to) {}
  /// Where the beginning is known as both.
  StepInterval(Time step_from, double from_seconds, Time step_to)
      : from(step_from),
        to(step_to),
        begin_seconds(from_seconds),
        end_seconds(to_seconds(step_to)) {}

  Time from, to;
  double begin_seconds, end_seconds;
};

/// Variables of one type that are read or written by one call, and where their values stand.
struct BoundValues {
  BoundValues(std::span<const ValueReference> variables, ValueBlock& values)
      : references(variables), block(&values) {
    if (values.type() == ValueType::Float64) float64s = values.numbers<double>();
  }

  std::span<const ValueReference> references;
  std::span<double> float64s;  ///< the block's elements, if they are of this type
  ValueBlock* block;
};

/// What goes into a unit before a step, and comes out of it behind.
struct StepValues {
  std::span<const BoundValues> inputs, outputs;
};

/// How a communication step ended.
struct StepResult {
  bool rejected = false;      ///< the unit is as it was before the step, and stands at its begin
  bool early_return = false;  ///< it stopped before the end
  bool event_needed = false;  ///< it wants Event Mode where it stands now
  bool terminate = false;     ///< it wants the simulation to end
  /// Where it stands now. Of a rejected step: how far the unit would have come; what is not within
  /// the step means that it does not say.
  Time reached{};

  /// It stands where it was sent, and wants nothing.
  bool went_through(Time to) const {
    return reached == to && !(rejected | early_return | event_needed | terminate);
  }
};

/// How a super-dense instant of Event Mode ended.
struct EventResult {
  bool iterate = false;  ///< it wants another one
  bool terminate = false;
  std::optional<Time> next_event;
};

/// One instance of a unit: what each unit has, and the way to ask for what only some have. Call
/// order, as in FMI 3.0 Co-Simulation:
///
///   set (start values), enter_initialization, {get, set}, exit_initialization, then
///   {events: {get, set, update_discrete_states}, enter_step_mode, {get, set, step},
///   enter_event_mode}, terminate.
///
/// With has_event_mode the unit is in Event Mode after exit_initialization, without in Step Mode.
/// Each function throws core::Error that names the unit. An object is used by one thread at a time.
class Unit {
 public:
  virtual ~Unit() = default;

  virtual void enter_initialization(Time start, std::optional<Time> stop) = 0;
  virtual void exit_initialization() = 0;

  /// Reads the variables (all of the block's type) into the block, in order, arrays element by
  /// element.
  virtual void get(std::span<const ValueReference> references, ValueBlock& values) = 0;
  virtual void set(std::span<const ValueReference> references, const ValueBlock& values) = 0;

  virtual StepResult step(const StepInterval& interval) = 0;
  /// Sets the inputs, steps and, unless the step was rejected, gets the outputs.
  virtual StepResult step(const StepInterval& interval, const StepValues& values) {
    for (const BoundValues& input : values.inputs) set(input.references, *input.block);
    const StepResult result = step(interval);
    if (result.rejected) return result;
    for (const BoundValues& output : values.outputs) get(output.references, *output.block);
    return result;
  }

  virtual void enter_event_mode() = 0;
  virtual EventResult update_discrete_states() = 0;
  virtual void enter_step_mode() = 0;

  virtual void terminate() = 0;

  /// The unit's implementation of the capability; null if the unit does not have it. The answer
  /// never changes, so it is asked for once, where a run begins, and kept.
  Capability* capability(CapabilityId id) { return find_capability(id); }
  template <CapabilityInterface C>
  C* capability() {
    return static_cast<C*>(find_capability(C::kId));
  }
  /// Likewise of a unit whose description promises it. Throws std::logic_error if the unit does not
  /// have it.
  template <CapabilityInterface C>
  C& require_capability() {
    if (C* const found = capability<C>()) return *found;
    throw std::logic_error("a unit does not have a capability that its description promises");
  }

 private:
  /// The unit's interface with this identifier, as a pointer made from a pointer to that interface
  /// (select_capability()); null if it does not have the capability.
  virtual Capability* find_capability(CapabilityId /*id*/) { return nullptr; }
};

/// The capability C of each unit, in their order; null where a unit does not have it.
template <CapabilityInterface C>
std::vector<C*> capabilities(std::span<const std::unique_ptr<Unit>> units) {
  std::vector<C*> found;
  found.reserve(units.size());
  for (const std::unique_ptr<Unit>& unit : units) found.push_back(unit->capability<C>());
  return found;
}

}  // namespace stride::core

#endif
