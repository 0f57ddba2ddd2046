// The description of a unit: the part of a modelDescription.xml that a master needs.
#ifndef STRIDE_MASTER_ENGINE_MODEL_DESCRIPTION_H
#define STRIDE_MASTER_ENGINE_MODEL_DESCRIPTION_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <stride/time.h>
#include <stride/value_type.h>

#include "master/engine/model/time/interval.h"
#include "master/engine/model/unit_of_measure.h"

namespace stride::core {

using ValueReference = std::uint32_t;

using ValueType = stride::Type;
inline constexpr std::size_t kValueTypeCount = std::size(kTypeNames);

/// Whether it is a floating-point type.
inline bool is_real(ValueType type) {
  return type == ValueType::Float64 || type == ValueType::Float32;
}

enum class Causality : std::uint8_t {
  Parameter,
  CalculatedParameter,
  StructuralParameter,
  Input,
  Output,
  Local,
  Independent,
};
enum class Variability : std::uint8_t { Constant, Fixed, Tunable, Discrete, Continuous };

/// FMI's `initial`; None where it does not apply, as for the independent variable.
enum class Initial : std::uint8_t { Exact, Approx, Calculated, None };

/// FMI's intervalVariability (FMI 3.0, 2.2.8). Triggered clocks have no interval; all others are
/// time-based. Periodic: Constant (interval in the description), Fixed (set at initialization),
/// Tunable (may change at events). Aperiodic: Changing (the unit gives the next interval at each
/// tick), Countdown (at any event).
enum class IntervalVariability : std::uint8_t {
  Constant,
  Fixed,
  Tunable,
  Changing,
  Countdown,
  Triggered,
};
inline constexpr std::size_t kIntervalVariabilityCount = 6;

/// The words of the standard: "Float64", "input", "continuous", "countdown".
const char* name(ValueType type);
/// "a Float64", "an Int32".
std::string name_with_article(ValueType type);
const char* name(Causality causality);
const char* name(Variability variability);
const char* name(Initial initial);
const char* name(IntervalVariability variability);

/// The attributes of a <Clock>.
struct ClockAttributes {
  IntervalVariability variability = IntervalVariability::Triggered;
  std::optional<Interval> interval;  ///< of a periodic clock; empty if the unit determines it
  Interval shift;                  ///< from the start to the first tick, where there is an interval
  bool supports_fraction = false;  ///< the unit can give intervals as fractions
  bool can_be_deactivated = false;
  std::optional<std::uint32_t> priority;  ///< of no meaning in Co-Simulation

  bool is_periodic() const { return variability <= IntervalVariability::Tunable; }
};

struct Dimension {
  constexpr Dimension(std::size_t elements, std::optional<ValueReference> given_by = {})
      : size(elements), parameter(given_by) {}

  std::size_t size;
  std::optional<ValueReference> parameter;  ///< the structural parameter that gives it
  bool operator==(const Dimension&) const = default;
};

/// Upper limit of the elements of an array, against excessive allocation.
inline constexpr std::size_t kMaxElements = std::size_t{1} << 28;

/// The product of the sizes; nothing if it is above kMaxElements.
std::optional<std::size_t> element_count(const std::vector<Dimension>& dimensions);

struct Variable {
  std::string name;
  std::vector<std::string> aliases;  ///< its other names
  ValueReference reference = 0;
  ValueType type = ValueType::Float64;
  Causality causality = Causality::Local;
  Variability variability = Variability::Continuous;
  Initial initial = Initial::Calculated;
  std::vector<Dimension> dimensions;  ///< empty for a scalar
  std::size_t size = 1;               ///< the number of elements
  std::string unit;
  bool is_relative = false;  ///< a difference: its unit is converted without the offset
  std::string description;
  std::string start;  ///< as in the description; elements separated by blanks
  std::string min;    ///< likewise, empty if there is none
  std::string max;
  double nominal = 0;  ///< of a floating-point number, the magnitude to expect; 0 = unspecified
  std::vector<ValueReference> clocks;                       ///< the clocks that it belongs to
  std::optional<ClockAttributes> clock;                     ///< of a Clock
  std::vector<std::pair<std::string, std::int64_t>> items;  ///< of an Enumeration

  /// Where the unit has one value for several variables (aliases of FMI 1.0 and 2.0): the first of
  /// them; of that one, and of other variables, nothing.
  std::optional<ValueReference> shares_value_of;
  bool is_negated = false;  ///< an alias that has the negative value, or the other Boolean

  /// Of a continuous input or an output: it may be accessed within a step.
  bool intermediate_update = false;

  /// Of a Float64 input: the change that ends an idle promise.
  double deadband = 0;
  /// Of a Float64 output: the maximum distance from its tangent during an idle promise; without one
  /// the output is constant meanwhile.
  std::optional<double> tolerance;
  bool has_derivative = false;  ///< of an output with a tolerance: get_derivatives() knows it

  bool is_clocked() const { return !clocks.empty(); }
  bool belongs_to(ValueReference a_clock) const {
    return std::find(clocks.begin(), clocks.end(), a_clock) != clocks.end();
  }
  /// Whether it is neither a clock nor belongs to one.
  bool is_unclocked_value() const { return type != ValueType::Clock && !is_clocked(); }
  bool is_triggered_clock() const {
    return clock && clock->variability == IntervalVariability::Triggered;
  }
  /// Whether it is a clock that the master ticks by the time.
  bool is_time_based_clock() const {
    return clock && causality == Causality::Input &&
           clock->variability != IntervalVariability::Triggered;
  }
};

/// An output or initial unknown, and what it depends on. Empty = unspecified: all inputs.
struct Unknown {
  ValueReference reference = 0;
  std::optional<std::vector<ValueReference>> dependencies;
};

struct UnitDescription {
  std::string fmi_version;
  std::string model_name;
  std::string model_identifier;
  std::string instantiation_token;
  std::string description;
  std::string generation_tool;
  std::vector<Variable> variables;  ///< in the order of the description
  /// Names that the description has more than once, for variables that are not the same; the first
  /// of them has the name.
  std::set<std::string> ambiguous_names;
  UnitsOfMeasure units_of_measure;  ///< those whose meaning is given
  std::vector<Unknown> outputs;
  std::vector<Unknown> initial_unknowns;

  bool has_event_mode = false;
  bool can_save_state = false;
  bool can_serialize_state = false;
  bool can_vary_step = false;
  bool may_return_early = false;
  bool single_instance = false;
  bool needs_execution_tool = false;
  /// It can ask for its inputs within a step (fmi3IntermediateUpdateCallback).
  bool provides_intermediate_update = false;
  bool provides_directional_derivatives = false;
  unsigned max_output_derivative_order = 0;
  /// It can promise to be idle (org.stride.idle, see <stride/idle.h>).
  bool promises_idle = false;
  /// Whether the unit may reject a step (fmi3Discard); true unless it declares otherwise.
  bool may_reject = true;
  /// Steps of any sizes between two instants lead to the same values, but for rounding, while the
  /// inputs are held; false unless the unit declares it.
  bool split_invariant = false;
  /// Whether a copy of its process has all of its state; true unless the unit declares otherwise.
  bool allows_snapshots = true;
  /// The index of the Boolean output that is the unit's verdict on a run, if it gives one, and of
  /// the String output that explains it.
  std::optional<std::size_t> verdict;
  std::optional<std::size_t> verdict_text;
  std::optional<Interval> fixed_internal_step;
  std::optional<Interval> maximum_step;     ///< no step may be longer
  std::optional<Interval> default_step;     ///< DefaultExperiment
  std::optional<Time> default_start;        ///< likewise; may be negative
  std::optional<Time> default_stop;         ///< Time::max(): later than times can be counted
  std::optional<double> default_tolerance;  ///< relative, of the unit's own solver
  std::vector<std::string> warnings;        ///< of what is odd in the description, but no mistake

  /// The variable's index in `variables`, if there is one of that name or alias.
  std::optional<std::size_t> find(const std::string& variable_name) const;
  /// The index of the variable with this value reference.
  std::optional<std::size_t> find(ValueReference reference) const;

  /// Gives a structural parameter its value: the arrays whose dimensions depend on it get their
  /// sizes. Returns the first variable that would have too many elements, and is then unchanged.
  const Variable* resize(ValueReference structural_parameter, std::size_t value);

  /// Whether the variable belongs to time-based clocks only: its value is exchanged at their ticks,
  /// and holds between them.
  bool is_sampled(const Variable& variable) const;
  /// Whether the variable is a message: its value exists at the ticks of a triggered clock only.
  bool is_message(const Variable& variable) const {
    return variable.is_clocked() && !is_sampled(variable);
  }
  /// Of a clock: the first variable of its causality that belongs to it; null if it is a bare one.
  const Variable* carried_by(const Variable& clock) const;
  /// Whether its ticks are reported as messages: of a clock that carries values, these are.
  bool is_reported(const Variable& variable) const {
    if (variable.type != ValueType::Clock) return is_message(variable);
    return variable.is_triggered_clock() && carried_by(variable) == nullptr;
  }
};

}  // namespace stride::core

#endif
