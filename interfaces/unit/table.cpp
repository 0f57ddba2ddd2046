#include "interfaces/unit/table.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <stride/variable_name.h>

#include "interfaces/unit/legal_calls.h"
#include "interfaces/unit/units_of_measure.h"
#include "interfaces/unit/xml_writer.h"

namespace stride {

VariableBuilder Unit::add_row(std::string name, Causality causality, Initial initial, Type type,
                              void* data, std::size_t size, std::vector<std::size_t> dimensions) {
  Variable& row = variables_.emplace_back();
  row.name = std::move(name);
  row.type = type;
  row.causality = causality;
  row.initial = type == Type::Clock ? Initial::None : initial;
  const bool is_real = type == Type::Float32 || type == Type::Float64;
  row.variability = causality == Causality::Parameter ? Variability::Fixed
                    : is_real                         ? Variability::Continuous
                                                      : Variability::Discrete;
  row.data = data;
  row.size = size;
  row.dimensions = std::move(dimensions);
  return VariableBuilder(row);
}

}  // namespace stride

namespace stride::kit {
namespace {

std::uint8_t settable_modes(const Variable& row) {
  if (row.variability == Variability::Constant || row.causality == Causality::Independent) return 0;
  if (row.type == Type::Clock) return row.causality == Causality::Input ? EventMode : 0;
  std::uint8_t modes = row.initial == Initial::Exact ? Instantiated | InitializationMode : 0;
  const bool tunable =
      row.causality == Causality::Parameter && row.variability == Variability::Tunable;
  if (row.causality == Causality::Input || tunable) modes |= EventMode;
  if ((row.causality == Causality::Input && row.clock == nullptr) || tunable) modes |= StepMode;
  if (row.intermediate) modes |= IntermediateUpdateMode;
  return modes;
}

Slot slot_of(const Variable& row) {
  const Type type = row.type == Type::Enumeration ? Type::Int64 : row.type;
  const bool is_discrete = row.variability != Variability::Continuous;
  return {type, settable_modes(row), is_discrete, row.size, row.data};
}

[[noreturn]] void reject(const Variable& row, const std::string& mistake) {
  throw std::logic_error("variable '" + row.name + "': " + mistake);
}

void check_name(const Variable& row) {
  if (row.name.empty()) throw std::logic_error("a variable has no name");
  if (is_structured_name(row.name)) return;
  reject(row,
         "this is not a structured name (FMI 3.0, 2.4.7.5.1); expected identifiers joined by "
         "dots, such as \"arm.joint_1\", \"axes[2,1]\" or \"der(x)\", with anything else in single "
         "quotes, such as \"'left arm'.angle\"");
}

void check_shape(const Variable& row) {
  const std::size_t product = std::accumulate(row.dimensions.begin(), row.dimensions.end(),
                                              std::size_t{1}, std::multiplies<>());
  if (row.size == 0) reject(row, "an array needs at least one element when it is declared");
  if (product != row.size) {
    reject(row, "the dimensions make " + std::to_string(product) + " elements, the member has " +
                    std::to_string(row.size));
  }
  if (row.type == Type::Clock && row.size != 1) reject(row, "arrays of clocks are not supported");
}

/// Whether a type can hold a bound. The largest integers are one less than a power of two, which,
/// unlike them, each double type has.
template <class T>
bool can_hold(double bound) {
  if (!std::isfinite(bound)) return false;
  if constexpr (std::is_floating_point_v<T>) {
    return std::abs(bound) <= static_cast<double>(std::numeric_limits<T>::max());
  } else {
    const double end = std::ldexp(1.0, std::numeric_limits<T>::digits);
    return bound == std::floor(bound) && bound < end && bound >= (std::is_signed_v<T> ? -end : 0);
  }
}

void check_bounds(const Variable& row) {
  if (!row.min && !row.max) return;
  visit(row.type, row.data, [&](const auto* elements) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(elements)>>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      for (const auto& bound : {row.min, row.max}) {
        if (!bound || can_hold<T>(*bound)) continue;
        reject(row,
               "the bound " + to_text(*bound) + " is not a value of the type " + name(row.type));
      }
    } else {
      reject(row, std::string("the type ") + name(row.type) + " has no bounds");
    }
  });
  if (row.min && row.max && *row.min > *row.max) {
    reject(row, "the minimum " + to_text(*row.min) + " is above the maximum " + to_text(*row.max));
  }
}

void check_idle(const Variable& row, bool promises_idle) {
  if (!row.deadband && !row.tolerance) return;
  const bool is_real = row.type == Type::Float64;
  if (row.deadband && (!is_real || row.causality != Causality::Input)) {
    reject(row, "only a Float64 input has a deadband");
  }
  if (row.tolerance && (!is_real || row.causality != Causality::Output)) {
    reject(row, "only a Float64 output has a tolerance");
  }
  if (row.deadband && !(*row.deadband >= 0 && std::isfinite(*row.deadband))) {
    reject(row, "the deadband is " + to_text(*row.deadband) + ", expected at least 0");
  }
  if (row.tolerance && !(*row.tolerance > 0 && std::isfinite(*row.tolerance))) {
    reject(row, "the tolerance is " + to_text(*row.tolerance) + ", expected more than 0");
  }
  if (!promises_idle) {
    reject(row,
           "a deadband or tolerance is for a unit that promises to be idle; set "
           "describe(...).promises_idle, or leave it out");
  }
}

void check_timing(const Variable& row) {
  const bool is_input = row.causality == Causality::Input;
  const bool is_timed = row.interval_variability != IntervalVariability::Triggered;
  if (is_timed && (row.type != Type::Clock || !is_input)) {
    reject(row, "only an input clock can tick by the time");
  }
  if (row.intermediate && (!is_input || row.variability != Variability::Continuous)) {
    reject(row, "only a continuous input can be intermediate()");
  }
}

}  // namespace

const char* name(Causality causality) {
  constexpr const char* kNames[] = {"independent", "parameter", "input", "output", "local"};
  return kNames[static_cast<std::size_t>(causality)];
}

const char* name(Variability variability) {
  constexpr const char* kNames[] = {"constant", "fixed", "tunable", "discrete", "continuous"};
  return kNames[static_cast<std::size_t>(variability)];
}

const char* name(IntervalVariability variability) {
  constexpr const char* kNames[] = {"constant", "fixed",     "tunable",
                                    "changing", "countdown", "triggered"};
  return kNames[static_cast<std::size_t>(variability)];
}

Table::Table(const Unit& unit, double& time) {
  time_.name = "time";
  time_.causality = Causality::Independent;
  time_.unit = "s";
  time_.description = "simulated time";
  time_.data = &time;
  rows_.push_back(&time_);
  for (const Variable& row : unit.variables()) rows_.push_back(&row);
  index_rows();
  check_units_of_measure(unit);
  for (const Variable* row : rows_) {
    check(*row);
    check_idle(*row, unit.info().promises_idle);
    slots_.push_back(slot_of(*row));
    if (row->type == Type::Clock) {
      auto& clocks = row->causality == Causality::Input ? input_clocks_ : output_clocks_;
      clocks.push_back(static_cast<Clock*>(row->data));
    }
  }
  check_verdict();
}

void Table::index_rows() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Variable& row = *rows_[i];
    const auto reference = static_cast<fmi3ValueReference>(i);
    if (!references_.emplace(row.name, reference).second) reject(row, "this name is used twice");
    if (row.type == Type::Clock) clock_references_.emplace(row.data, reference);
  }
}

void Table::check(const Variable& row) const {
  check_name(row);
  check_shape(row);
  check_bounds(row);
  check_timing(row);
  if (row.type == Type::Enumeration && row.items.empty()) {
    reject(row, "an enumeration needs its items({{\"name\", value}, ...})");
  }
  if (!row.unit.empty() && row.type != Type::Float64 && row.type != Type::Float32) {
    reject(row, "only Float32 and Float64 variables have a unit in FMI 3.0");
  }
  if (row.is_relative && row.unit.empty()) {
    reject(row, "relative() is for variables with a unit of measure, whose offset it leaves out");
  }
  if (row.derivative != nullptr &&
      (row.type != Type::Float64 || row.causality != Causality::Output)) {
    reject(row, "only a Float64 output has an output derivative");
  }
  check_references(row);
}

void Table::check_references(const Variable& row) const {
  if (row.clock != nullptr) reference_of(*row.clock);
  if (!row.dependencies) return;
  if (row.type == Type::Clock) {
    reject(row,
           "a clock has no depends_on(): its ticks are seen after the instant of their cause, "
           "so it depends on no input of its own instant");
  }
  for (const std::string& dependency : *row.dependencies) reference_of(dependency);
}

void Table::check_verdict() const {
  const Variable* verdict = nullptr;
  const Variable* text = nullptr;
  const auto take = [](const Variable& row, Type type, const Variable*& first) {
    if (row.type != type || row.causality != Causality::Output || !row.dimensions.empty() ||
        row.clock != nullptr) {
      reject(row, std::string("only a scalar ") + name(type) + " output without a clock can be a " +
                      (type == Type::Boolean ? "verdict()" : "verdict_text()"));
    }
    if (first != nullptr) reject(row, "'" + first->name + "' is that already; a unit has one");
    first = &row;
  };
  for (const Variable* row : rows_) {
    if (row->is_verdict) take(*row, Type::Boolean, verdict);
    if (row->is_verdict_text) take(*row, Type::String, text);
  }
  if (text != nullptr && verdict == nullptr) {
    reject(*text, "there is no verdict to explain; call verdict() of a Boolean output, too");
  }
}

fmi3ValueReference Table::reference_of(const Clock& clock) const {
  const auto found = clock_references_.find(&clock);
  if (found != clock_references_.end()) return found->second;
  throw std::logic_error("a variable is clocked by a clock that is not in the variable table");
}

fmi3ValueReference Table::reference_of(const std::string& name) const {
  const auto found = references_.find(name);
  if (found != references_.end()) return found->second;
  throw std::logic_error("depends_on names the variable '" + name + "', which does not exist");
}

}  // namespace stride::kit
