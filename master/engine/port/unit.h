// The unit port: an instance of an FMU as the algorithm uses it.
#ifndef STRIDE_MASTER_ENGINE_PORT_UNIT_H
#define STRIDE_MASTER_ENGINE_PORT_UNIT_H

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/description.h"
#include "master/engine/model/values.h"
#include "master/engine/port/capability.h"

namespace stride::core {

/// A communication step; its ends and its size also in seconds, as they are passed to units.
///
/// Each is converted from exact time by itself, so a regular step has the same size everywhere, and
/// units that compare it with their own period accept it. The end is then the sum of beginning
/// and size but for the rounding of that sum. Where the rounding of the ends is more than a
/// millionth of the step, its size is their difference.
struct StepInterval {
  StepInterval(Time step_from, Time step_to)
      : StepInterval(step_from, to_seconds(step_from), step_to) {}
  /// For a beginning whose value in seconds is known.
  StepInterval(Time step_from, double from_seconds, Time step_to)
      : StepInterval(step_from, from_seconds, step_to, to_seconds(step_to),
                     to_seconds(step_to - step_from)) {}
  /// With all of them in seconds.
  StepInterval(Time step_from, double from_seconds, Time step_to, double until_seconds,
               double in_seconds)
      : from(step_from),
        to(step_to),
        begin_seconds(from_seconds),
        end_seconds(until_seconds),
        size_seconds(in_seconds) {
    const double difference = end_seconds - begin_seconds;
    if (std::abs(size_seconds - difference) > 1e-6 * size_seconds) size_seconds = difference;
  }

  Time from, to;
  double begin_seconds, end_seconds;
  double size_seconds;  ///< 0 if the ends are the same double
  /// Whether the unit may be taken back to a state from before `from`.
  bool may_go_back_before = false;
};

/// Variables of one type, read or written by one call, and the block that holds their values.
struct BoundValues {
  BoundValues(std::span<const ValueReference> variables, ValueBlock& values)
      : references(variables), block(&values) {
    if (values.type() == ValueType::Float64) float64s = values.numbers<double>();
  }

  std::span<const ValueReference> references;
  std::span<double> float64s;  ///< the block's elements, if they are of this type
  ValueBlock* block;
};

/// The inputs to set before a step and the outputs to get after it.
struct StepValues {
  std::span<const BoundValues> inputs, outputs;
};

/// How a communication step ended.
struct StepResult {
  bool rejected = false;               ///< the unit is in the state before the step
  bool early_return = false;           ///< it returned before the end
  bool event_handling_needed = false;  ///< it requests Event Mode at `reached`
  bool terminate_simulation = false;   ///< it requests the end of the simulation
  /// The time that the unit has reached. Of a rejected step: the time that it could have reached; a
  /// time outside of the step means unknown.
  Time reached{};

  /// Whether it reached `to` and requested nothing.
  bool reached_without_request(Time to) const {
    return reached == to &&
           !(rejected | early_return | event_handling_needed | terminate_simulation);
  }
};

/// The result of one event iteration.
struct EventResult {
  bool discrete_states_need_update = false;  ///< another iteration is required
  bool terminate_simulation = false;
  std::optional<Time> next_event_time;
};

/// An instance of a unit: the functions that all units have, and access to optional capabilities.
/// Call order, as in FMI 3.0 Co-Simulation:
///
///   set (start values), enter_initialization, {get, set}, exit_initialization, then
///   {events: {get, set, update_discrete_states}, enter_step_mode, {get, set, step},
///   enter_event_mode}, terminate, free.
///
/// With has_event_mode the unit is in Event Mode after exit_initialization, without in Step Mode.
/// Each function throws core::Error that names the unit. An object is used by one thread at a time.
class Unit {
 public:
  virtual ~Unit() = default;

  virtual void enter_initialization(Time start, std::optional<Time> stop) = 0;
  virtual void exit_initialization() = 0;

  /// Reads the variables (all of the block's type) into the block, in order, arrays element by
  /// element; the block has as many elements as all of them.
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

  /// Frees what the unit has of its own. No other call may follow. The destructor does so, too,
  /// where it has not been called; only this function can report a failure.
  virtual void free() {}

  /// The unit's implementation of the capability, or null. It never changes, so it is requested
  /// once per run.
  Capability* capability(CapabilityId id) { return find_capability(id); }
  template <CapabilityInterface C>
  C* capability() {
    return static_cast<C*>(find_capability(C::kId));
  }
  /// The same for a capability that the description declares. Throws std::logic_error if it is
  /// missing.
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
