// The part of System that checks and makes its start values.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "master/model/meant_value.h"
#include "master/model/system.h"
#include "master/model/unknown_variable.h"
#include "master/model/way.h"
#include "master/util/limited_warnings.h"
#include "master/util/message_text.h"

namespace stride::core {
namespace {

/// Only what FMI calls initial = exact or approx can be set before the start; of FMI 1.0, which has
/// no such word, what has a start value.
void check_settable(const UnitDescription& unit, const Variable& variable, const Context& context) {
  const bool exact = variable.initial == Initial::Exact || variable.initial == Initial::Approx;
  if (exact && variable.variability != Variability::Constant && variable.type != ValueType::Clock) {
    return;
  }
  if (unit.fmi_version.starts_with("1.")) {
    const bool is_constant = variable.variability == Variability::Constant;
    fail_input(context,
               is_constant ? "a constant cannot be set"
                           : fmt::format("a {} {} without a start value cannot be set",
                                         name(variable.variability), name(variable.causality)),
               "parameters, inputs and, in FMI 1.0, what has a start value in the model "
               "description can");
  }
  fail_input(context,
             fmt::format("a {} {} with initial = {} cannot be set", name(variable.variability),
                         name(variable.causality), name(variable.initial)),
             "parameters, inputs and what the unit declares as initial = exact can");
}

/// What is expected in place of a number that is out of range.
std::string bound_text(const Variable& variable, double number, double least, double most) {
  if (number < least) return "at least " + variable.min;
  return number > most ? "at most " + variable.max : "a number";
}

/// Whether the element lies within min and max, which are texts in the description.
void check_range(const Variable& variable, const ValueBlock& value, const Context& context) {
  visit(value, [&](auto elements) {
    using T = typename decltype(elements)::value_type;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<std::remove_const_t<T>, bool>) {
      const auto bound = [&](const std::string& text, double otherwise) {
        return text.empty() ? otherwise : std::strtod(text.c_str(), nullptr);
      };
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      const double least = bound(variable.min, -kInfinity);
      const double most = bound(variable.max, kInfinity);
      for (const auto element : elements) {
        const double number = static_cast<double>(element);
        if (number >= least && number <= most) continue;
        if (std::isnan(number) && variable.min.empty() && variable.max.empty()) continue;
        fail_input(context, fmt::format("the value {} is out of range, expected {}", element,
                                        bound_text(variable, number, least, most)));
      }
    }
  });
}

void convert_start(ValueBlock& value, const LinearConversion& conversion) {
  if (conversion.is_identity()) return;  // which keeps the sign of -0
  visit(value, [&](auto elements) {
    using T = typename decltype(elements)::value_type;
    if constexpr (std::is_floating_point_v<T>) {
      for (T& element : elements) {
        element = static_cast<T>(conversion.factor * element + conversion.offset);
      }
    }
  });
}

}  // namespace

/// Nothing, and a warning, where a parameter set holds a value for no component, as SSP allows.
void System::note_missing(const StartDeclaration& wanted) {
  try {
    const std::size_t component = find_component(wanted.component, wanted.where);
    fail_unknown({wanted.where, wanted.component, wanted.variable, {}},
                 *components_[component].description, nullptr);
  } catch (const Error& mistake) {
    if (!wanted.is_optional) throw;
    warnings_.push_back(fmt::format("{}\n  the value is ignored, as SSP requires", mistake.what()));
  }
}

/// Of those that are there; of the others, what must not be ignored is an error.
std::vector<System::Target> System::find_targets(const SystemDeclaration& declaration,
                                                 Diagnostics& diagnostics) {
  std::vector<Target> targets;
  std::vector<const StartDeclaration*> missing;
  std::set<std::size_t> found_groups;
  for (const StartDeclaration& wanted : declaration.start_values) {
    const std::size_t component = find_component(wanted.component, wanted.where);
    const auto place = names_.variable(component, wanted.variable);
    if (!place) {
      missing.push_back(&wanted);
      continue;
    }
    const VariableId id{component, *place};
    found_groups.insert(wanted.group);
    diagnostics.attempt([&] {
      const UnitDescription& description = *components_[component].description;
      const Context context{wanted.where, wanted.component, wanted.variable, {}};
      check_unambiguous(context, description);
      check_settable(description, variable(id), context);
      targets.push_back({&wanted, id});
    });
  }
  LimitedWarnings ignored(warnings_,
                          "values of variables that are not there, which are ignored, too");
  for (const StartDeclaration* wanted : missing) {
    if (wanted->group != 0 && found_groups.contains(wanted->group)) continue;
    if (wanted->is_optional && !ignored.count()) continue;
    diagnostics.attempt([&] { note_missing(*wanted); });
  }
  ignored.finish();
  return targets;
}

ValueBlock System::start_value(const StartDeclaration& wanted, VariableId id) {
  const Variable& target = variable(id);
  const UnitDescription& description = *components_[id.component].description;
  const Context context{wanted.where, wanted.component, wanted.variable, {}};
  const UnitOfMeasure unit = known_unit(wanted.unit, description);
  if (wanted.via.empty() && !wanted.suppress_unit_conversion &&
      !convert(unit, path_connector(whole(id)).unit)) {
    fail_input(context,
               fmt::format("the value is in '{}', the variable in '{}'", unit.name,
                           path_connector(whole(id)).unit.name),
               "give the value in the variable's unit");
  }
  Way way({"the value", {}, unit, {}, true});
  way.go(wanted, path_connector(whole(id)));
  const auto [text, linear] = compose_text(wanted.value, way.path, way.segments, context);
  const std::optional<std::string> meant = meant_value(target.type, text);
  if (meant) {
    warnings_.push_back(to_text(context) +
                        fmt::format("'{}' is taken for {}", name_text(text), *meant));
  }
  try {
    ValueBlock value = parse(target, meant.value_or(text));
    convert_start(value, linear);
    check_range(target, value, context);
    return value;
  } catch (const std::invalid_argument& mistake) {
    fail_input(context, mistake.what());
  }
}

void System::resize(const StartDeclaration& declaration, VariableId structural_parameter,
                    std::size_t size) {
  auto& shared = components_[structural_parameter.component].description;
  UnitDescription description = *shared;
  if (const Variable* large = description.resize(variable(structural_parameter).reference, size)) {
    fail_input({declaration.where, declaration.component, declaration.variable, {}},
               fmt::format("with the value {}, '{}' would have more than {} elements", size,
                           large->name, kMaxElements),
               "give a smaller value");
  }
  shared = std::make_shared<const UnitDescription>(std::move(description));
}

void System::add_structural_values(const std::vector<Target>& targets) {
  std::map<VariableId, ValueBlock> values;
  for (const auto& [wanted, id] : targets) {
    if (variable(id).causality != Causality::StructuralParameter) continue;
    ValueBlock value = start_value(*wanted, id);
    if (value.type() == ValueType::UInt64) resize(*wanted, id, value.numbers<std::uint64_t>()[0]);
    values.insert_or_assign(id, std::move(value));
  }
  for (auto& [id, value] : values) structural_values_.push_back({id, std::move(value)});
}

/// A value that was set by name, and nothing of which is what the unit gets.
void System::note_replaced(const StartDeclaration& wanted, VariableId id) {
  if (wanted.is_optional) return;
  const std::span<const Connection> sources = connections_to(id);
  if (sources.empty() || !unconnected_elements(id).empty()) return;
  warnings_.push_back(fmt::format(
      "{}'{}' is connected to '{}', whose value replaces this one at the initialisation",
      core::to_text(Context{wanted.where}), full_name(id), range_name(sources.front().source())));
}

void System::add_start_values(const std::vector<Target>& targets, Diagnostics& diagnostics) {
  std::map<VariableId, ValueBlock> values;
  for (const Target& target : targets) {
    const VariableId id = target.id;
    if (variable(id).causality == Causality::StructuralParameter) continue;
    diagnostics.attempt([&] { values.insert_or_assign(id, start_value(*target.declaration, id)); });
    note_replaced(*target.declaration, id);
  }
  for (auto& [id, value] : values) start_values_.push_back({id, std::move(value)});
}

}  // namespace stride::core
