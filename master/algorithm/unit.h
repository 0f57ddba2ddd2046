// The port behind which a unit lives, in this process or in another.
#ifndef STRIDE_MASTER_ALGORITHM_UNIT_H
#define STRIDE_MASTER_ALGORITHM_UNIT_H

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/statistics.h"
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

/// What a unit says of the interval of one of its time-based clocks.
struct ClockInterval {
  enum class State { NotYetKnown, Unchanged, Changed };
  State state = State::NotYetKnown;
  Interval interval{};  ///< with Unchanged, the one that was told before
};

/// Called by a unit within a step, `seconds_into_step` after its begin: sets those of its inputs
/// that have `intermediate_update` to their values at that instant. Instants come in any order.
using InputUpdate = std::function<void(double seconds_into_step)>;

/// One instance of a unit. Call order, as in FMI 3.0 Co-Simulation:
///
///   {enter_configuration_mode, set (structural parameters), exit_configuration_mode},
///   set (start values), enter_initialization, {get, set}, exit_initialization, then
///   {events: {get, set, update_discrete_states}, enter_step_mode, {get, set, step},
///   enter_event_mode}, terminate.
///
/// With has_event_mode the unit stands in Event Mode after exit_initialization, without in Step
/// Mode. Each function throws core::Error that names the unit. An object is used by one thread at a
/// time.
class Unit {
 public:
  virtual ~Unit() = default;

  /// Only for a unit that has structural parameters.
  virtual void enter_configuration_mode() {}
  virtual void exit_configuration_mode() {}

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
  /// What the unit said when it last rejected a step; empty if it said nothing.
  virtual std::string rejection_reason() const { return {}; }

  /// Keeps what the unit is now, in place of what was kept before. Only with can_save_state.
  virtual void save_state() = 0;
  /// Makes the unit what it was at save_state(), any number of times.
  virtual void restore_state() = 0;
  /// Chooses among several kept states the one that the calls above and below are about; it is the
  /// first, 0, until another is chosen. The others stay.
  virtual void select_state(std::size_t /*slot*/) {
    throw std::logic_error("this kind of unit keeps one state only");
  }
  /// The kept state as bytes, for any unit of the same FMU, also in another process. Only with
  /// can_serialize_state.
  virtual std::vector<std::uint8_t> serialize_state() {
    throw std::logic_error("this kind of unit cannot serialise its state");
  }
  /// Keeps the state that these bytes are, in place of what was kept before.
  virtual void deserialize_state(std::span<const std::uint8_t> /*bytes*/) {
    throw std::logic_error("this kind of unit cannot deserialise a state");
  }
  /// Makes the unit what it was when it was made: no start value is set, and kept states stay. Also
  /// after it has failed, or was terminated.
  virtual void reset() { throw std::logic_error("this kind of unit cannot be reset"); }

  virtual void enter_event_mode() = 0;
  virtual EventResult update_discrete_states() = 0;
  virtual void enter_step_mode() = 0;

  /// The interval of a time-based clock that does not stand in the description. In Initialization
  /// Mode it counts from the first tick of a periodic clock, and from the start to the first tick
  /// of another; in Event Mode, after update_discrete_states(), from the present instant.
  virtual ClockInterval clock_interval(const Variable& /*clock*/) { return {}; }
  /// From the start to the first tick of a periodic clock; in Initialization Mode only.
  virtual Interval clock_shift(const Variable& /*clock*/) { return {}; }

  /// How Float64 and Float32 unknowns change with known inputs: the sum over the knowns of
  /// (∂ unknown / ∂ known) seed, arrays element by element. In Initialization Mode, Event Mode and
  /// Step Mode; only with provides_directional_derivatives.
  virtual void get_directional_derivative(std::span<const ValueReference> /*unknowns*/,
                                          std::span<const ValueReference> /*knowns*/,
                                          std::span<const double> /*seed*/,
                                          std::span<double> /*sensitivity*/) {
    throw std::logic_error("this kind of unit has no directional derivatives");
  }

  /// Whom to ask for inputs within a step; an empty function ends it. A unit that has no use for it
  /// steps with the inputs that it was given before.
  virtual void set_input_update(InputUpdate /*update*/) {}

  /// Before enter_initialization, with promises_idle: the unit may skip its own idle time, and will
  /// promise to be idle, for max_skip at most.
  virtual void enable_idle_skipping(Duration /*max_skip*/) {}
  /// Likewise: how far Float64 outputs may be from their tangents meanwhile.
  virtual void set_idle_tolerances(std::span<const ValueReference> /*outputs*/,
                                   std::span<const double> /*tolerances*/) {}
  /// Where a step or Event Mode has just ended: the instant before which the unit need not be
  /// called, while its inputs stay within their deadbands and none of its clocks is set. Not after
  /// the present instant if it promises nothing.
  virtual Time idle_until() { return Time::min(); }
  /// The first derivatives of Float64 outputs that have a tolerance, arrays element by element; 0
  /// where there is none (has_derivative).
  virtual void get_derivatives(std::span<const ValueReference> /*outputs*/,
                               std::span<double> /*derivatives*/) {}

  /// What a value of a Binary variable says, in the unit's own words, which nobody has looked at
  /// yet (readable_text()); empty where it says nothing. At any time; changes nothing.
  virtual std::string describe_message(ValueReference /*variable*/, const Binary& /*value*/) {
    return {};
  }

  virtual void terminate() = 0;

  /// How many functions of the unit's interface were called so far, where they are counted.
  virtual std::uint64_t calls() const { return 0; }

  /// Of the process that the unit has to itself; nothing if it has none. At any time, also after a
  /// failure.
  virtual std::optional<HostStatistics> host_statistics() const { return std::nullopt; }
};

}  // namespace stride::core

#endif
