// The variable table of a unit: one row per FMI variable, bound to a member of the unit's class.
#ifndef STRIDE_UNIT_VARIABLE_H
#define STRIDE_UNIT_VARIABLE_H

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <stride/time.h>
#include <stride/unit/clock.h>
#include <stride/value_type.h>

namespace stride {

enum class Causality : std::uint8_t { Independent, Parameter, Input, Output, Local };
enum class Variability : std::uint8_t { Constant, Fixed, Tunable, Discrete, Continuous };
enum class Initial : std::uint8_t { None, Exact, Approx, Calculated };

/// One row. Its start value is what the member holds when the unit's constructor returns.
struct Variable {
  std::string name;
  Type type = Type::Float64;
  Causality causality = Causality::Local;
  Variability variability = Variability::Continuous;
  Initial initial = Initial::None;
  std::vector<std::size_t> dimensions;  ///< empty for a scalar
  std::size_t size = 1;                 ///< the number of elements
  void* data = nullptr;                 ///< the first element; the elements are contiguous

  std::string description;
  std::string unit;
  bool is_relative = false;  ///< a difference: its unit is converted without the offset
  std::string mime_type;     ///< of a Binary variable
  std::optional<double> min;
  std::optional<double> max;
  std::vector<std::pair<std::string, std::int64_t>> items;  ///< of an Enumeration
  const Clock* clock = nullptr;                             ///< the clock that it belongs to
  bool intermediate = false;  ///< of an input: Step::update_inputs() asks for it
  IntervalVariability interval_variability = IntervalVariability::Triggered;  ///< of a Clock
  bool has_interval = false;  ///< of a periodic Clock: it is declared, not given by the unit
  const double* derivative = nullptr;  ///< of an output: its first derivative, element by element
  std::optional<std::vector<std::string>> dependencies;  ///< of an output: nothing = unknown = all
  std::optional<double> deadband;   ///< of a Float64 input, see <stride/idle.h>
  std::optional<double> tolerance;  ///< of a Float64 output, likewise
  bool is_verdict = false;          ///< of a Boolean output: it is the unit's verdict on the run
  bool is_verdict_text = false;     ///< of a String output: it explains the verdict
};

/// An item of an Enumeration: {"eco", Mode::eco} of an enum of the unit's, or {"eco", 2}.
struct EnumerationItem {
  template <class Value,
            std::enable_if_t<std::is_enum_v<Value> || std::is_integral_v<Value>, int> = 0>
  EnumerationItem(std::string item_name, Value item_value)
      : name(std::move(item_name)), value(static_cast<std::int64_t>(item_value)) {}

  std::string name;
  std::int64_t value;
};

/// What input(), output(), parameter() and local() return, to add more to the row. Units of
/// measure are written as Modelica does: "m", "km/h", "N.m", "W/(m2.K)", "degC"; see
/// <stride/unit_of_measure.h> and Unit::unit_of_measure().
class VariableBuilder {
 public:
  explicit VariableBuilder(Variable& row) : row_(row) {}

  VariableBuilder& description(std::string text) {
    return row_.description = std::move(text), *this;
  }
  VariableBuilder& unit(std::string symbol) { return row_.unit = std::move(symbol), *this; }
  /// A difference of two values, such as a temperature rise: 10 degC are 10 K, not 283.15 K.
  VariableBuilder& relative() { return row_.is_relative = true, *this; }
  VariableBuilder& mime_type(std::string type) { return row_.mime_type = std::move(type), *this; }
  /// Bounds, for numbers and enumerations; the type must be able to hold them.
  VariableBuilder& range(double min, double max) { return row_.min = min, row_.max = max, *this; }
  VariableBuilder& min(double value) { return row_.min = value, *this; }
  VariableBuilder& max(double value) { return row_.max = value, *this; }
  /// The product must be the number of elements.
  VariableBuilder& dimensions(std::vector<std::size_t> sizes) {
    return row_.dimensions = std::move(sizes), *this;
  }
  /// The names and values of an Enumeration.
  VariableBuilder& items(std::initializer_list<EnumerationItem> items) {
    row_.items.clear();
    for (const EnumerationItem& item : items) row_.items.emplace_back(item.name, item.value);
    return *this;
  }
  VariableBuilder& items(std::vector<std::pair<std::string, std::int64_t>> items) {
    return row_.items = std::move(items), *this;
  }
  VariableBuilder& tunable() { return row_.variability = Variability::Tunable, *this; }
  VariableBuilder& discrete() { return row_.variability = Variability::Discrete, *this; }
  VariableBuilder& constant() {
    return row_.variability = Variability::Constant, row_.initial = Initial::Exact, *this;
  }
  /// The start value is the value at the start: it may be set, and initialize() does not compute
  /// it.
  VariableBuilder& exact() { return row_.initial = Initial::Exact, *this; }
  /// The variable changes only when this clock ticks.
  VariableBuilder& clocked_by(const Clock& clock) {
    return row_.clock = &clock, row_.variability = Variability::Discrete, *this;
  }
  /// Step::update_inputs() asks for this continuous input within a step.
  VariableBuilder& intermediate() { return row_.intermediate = true, *this; }

  // When an input clock ticks by the time; without such a word it is triggered.

  /// At start + shift, and at each interval from then on.
  VariableBuilder& every(Duration interval, Duration shift = {}) {
    return periodic(IntervalVariability::Constant, interval, shift);
  }
  /// The same, but the importer may choose other lengths before the start.
  VariableBuilder& every_fixed(Duration interval, Duration shift = {}) {
    return periodic(IntervalVariability::Fixed, interval, shift);
  }
  /// The same, and another interval at any event.
  VariableBuilder& every_tunable(Duration interval, Duration shift = {}) {
    return periodic(IntervalVariability::Tunable, interval, shift);
  }
  /// Periodically, too, with the lengths that the unit sets: Clock::set_interval(), set_shift().
  VariableBuilder& every_fixed() { return timed(IntervalVariability::Fixed); }
  VariableBuilder& every_tunable() { return timed(IntervalVariability::Tunable); }
  /// Once after each Clock::count_down(), which each tick must be followed by.
  VariableBuilder& changing() { return timed(IntervalVariability::Changing); }
  /// Once after each Clock::count_down(), which any event may call.
  VariableBuilder& countdown() { return timed(IntervalVariability::Countdown); }

  /// The names of the inputs that an output depends on at the same instant; {} = none. Not for a
  /// clock, which never does: its ticks are seen one super-dense instant after their cause.
  VariableBuilder& depends_on(std::vector<std::string> names) {
    return row_.dependencies = std::move(names), *this;
  }
  /// The member that holds the first derivative of an output.
  VariableBuilder& derivative(const double& member) { return row_.derivative = &member, *this; }

  // For a unit that may promise to be idle (UnitInfo::promises_idle, Unit::idle_until()).

  /// How far this Float64 input may go from its value at the promise before that ends, in its unit,
  /// >= 0. Without one any change ends it.
  VariableBuilder& deadband(double width) { return row_.deadband = width, *this; }
  /// How far this Float64 output may be from its tangent at the promise while it holds, in its
  /// unit, > 0, unless the importer sets another. Without one it stays exactly what it is.
  VariableBuilder& tolerance(double width) { return row_.tolerance = width, *this; }

  // For a unit that judges the run; one output each.

  /// What this Boolean output is at the end of a run is the unit's verdict: false, and the run has
  /// failed, however well it went.
  VariableBuilder& verdict() { return row_.is_verdict = true, *this; }
  /// This String output explains the verdict, as human-readable text.
  VariableBuilder& verdict_text() { return row_.is_verdict_text = true, *this; }

 private:
  VariableBuilder& timed(IntervalVariability variability) {
    return row_.interval_variability = variability, *this;
  }
  VariableBuilder& periodic(IntervalVariability variability, Duration interval, Duration shift) {
    row_.has_interval = true;
    if (row_.type == Type::Clock) {
      static_cast<Clock*>(row_.data)->set_interval(interval);
      static_cast<Clock*>(row_.data)->set_shift(shift);
    }
    return timed(variability);
  }

  Variable& row_;
};

}  // namespace stride

#endif
