#include "master/scenario/signal_names.h"

#include <algorithm>

#include "master/util/glob.h"

namespace stride::io {

std::vector<NamedVariable> named_variables(const core::System& system) {
  std::vector<NamedVariable> found;
  for (std::size_t c = 0; c < system.components().size(); ++c) {
    const auto& variables = system.components()[c].description->variables;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (variables[v].causality == core::Causality::Independent) continue;  // the first column
      const bool is_message =
          variables[v].type == core::ValueType::Clock || system.is_message({c, v});
      found.push_back({{c, v}, system.full_name({c, v}), is_message});
    }
  }
  for (std::size_t i = 0; i < system.outputs().size(); ++i) {
    const core::VariableId id = system.output_id(i);
    found.push_back({id, system.full_name(id), false});
  }
  return found;
}

bool is_meant(const core::System& system, core::VariableId id, const std::string& pattern) {
  const auto is_matched = [&](const std::string& name) {
    return name == pattern || matches_glob(pattern, name);
  };
  if (is_matched(system.full_name(id))) return true;
  const std::vector<std::string>& aliases = system.variable(id).aliases;
  return std::any_of(aliases.begin(), aliases.end(), [&](const std::string& alias) {
    return is_matched(system.prefix(id) + alias);
  });
}

}  // namespace stride::io
