#include "master/engine/model/description.h"

#include <algorithm>
#include <string_view>

namespace stride::core {

const char* name(ValueType type) { return type_name(type); }

std::string name_with_article(ValueType type) {
  const std::string word = name(type);
  return (std::string_view("AEI").find(word.front()) != std::string_view::npos ? "an " : "a ") +
         word;
}

const char* name(Causality causality) {
  constexpr const char* kNames[] = {
      "parameter", "calculatedParameter", "structuralParameter", "input", "output",
      "local",     "independent"};
  return kNames[static_cast<std::size_t>(causality)];
}

const char* name(Variability variability) {
  constexpr const char* kNames[] = {"constant", "fixed", "tunable", "discrete", "continuous"};
  return kNames[static_cast<std::size_t>(variability)];
}

const char* name(Initial initial) {
  constexpr const char* kNames[] = {"exact", "approx", "calculated", "none"};
  return kNames[static_cast<std::size_t>(initial)];
}

const char* name(IntervalVariability variability) {
  constexpr const char* kNames[] = {"constant", "fixed",     "tunable",
                                    "changing", "countdown", "triggered"};
  return kNames[static_cast<std::size_t>(variability)];
}

std::optional<std::size_t> UnitDescription::find(const std::string& variable_name) const {
  const auto found = std::find_if(variables.begin(), variables.end(), [&](const Variable& v) {
    return v.name == variable_name ||
           std::find(v.aliases.begin(), v.aliases.end(), variable_name) != v.aliases.end();
  });
  if (found == variables.end()) return std::nullopt;
  return static_cast<std::size_t>(found - variables.begin());
}

std::optional<std::size_t> UnitDescription::find(ValueReference reference) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const Variable& v) { return v.reference == reference; });
  if (found == variables.end()) return std::nullopt;
  return static_cast<std::size_t>(found - variables.begin());
}

std::optional<std::size_t> element_count(const std::vector<Dimension>& dimensions) {
  std::size_t count = 1;
  for (const Dimension& dimension : dimensions) {
    if (dimension.size == 0) return 0;
    if (dimension.size > kMaxElements / count) return std::nullopt;
    count *= dimension.size;
  }
  return count;
}

const Variable* UnitDescription::resize(ValueReference structural_parameter, std::size_t value) {
  std::vector<Variable> resized = variables;
  for (std::size_t i = 0; i < resized.size(); ++i) {
    Variable& variable = resized[i];
    for (Dimension& dimension : variable.dimensions) {
      if (dimension.parameter == structural_parameter) dimension.size = value;
    }
    const auto size = element_count(variable.dimensions);
    if (!size) return &variables[i];
    variable.size = *size;
  }
  variables = std::move(resized);
  return nullptr;
}

const Variable* UnitDescription::carried_by(const Variable& clock) const {
  const auto carried = std::ranges::find_if(variables, [&](const Variable& other) {
    return other.causality == clock.causality && other.belongs_to(clock.reference);
  });
  return carried == variables.end() ? nullptr : &*carried;
}

bool UnitDescription::is_sampled(const Variable& variable) const {
  return variable.is_clocked() &&
         std::all_of(variable.clocks.begin(), variable.clocks.end(), [&](ValueReference clock) {
           const auto place = find(clock);
           return place && variables[*place].is_time_based_clock();
         });
}

}  // namespace stride::core
