#include "master/scenario/signal_selection.h"

#include <set>
#include <string>

#include <fmt/format.h>

#include "master/scenario/signal_names.h"
#include "master/util/suggest.h"

namespace stride::io {
namespace {

[[noreturn]] void fail_without_match(const SignalPattern& pattern, const NamedVariable* message,
                                     const std::vector<NamedVariable>& all) {
  if (message != nullptr) {
    core::fail_input({.where = pattern.where},
                     fmt::format("'{}' cannot be recorded as a signal: '{}' belongs to a clock and "
                                 "has a value only when that ticks",
                                 pattern.text, message->name),
                     "each of its messages is in events.csv, without being asked for");
  }
  std::vector<std::string> names;
  for (const NamedVariable& variable : all) {
    if (!variable.is_message) names.push_back(variable.name);
  }
  core::fail_input({.where = pattern.where},
                   fmt::format("'{}' matches no variable to record", pattern.text),
                   core::suggestion(pattern.text, names));
}

std::vector<core::VariableId> all_outputs(const core::System& system) {
  std::vector<core::VariableId> outputs;
  for (const NamedVariable& variable : named_variables(system)) {
    const bool is_output = system.variable(variable.id).causality == core::Causality::Output;
    if (is_output && !variable.is_message) outputs.push_back(variable.id);
  }
  return outputs;
}

}  // namespace

std::vector<core::VariableId> select_signals(const core::System& system,
                                             std::span<const SignalPattern> patterns) {
  if (patterns.empty()) return all_outputs(system);
  const std::vector<NamedVariable> all = named_variables(system);
  std::vector<core::VariableId> selected;
  std::set<core::VariableId> taken;
  for (const SignalPattern& pattern : patterns) {
    const NamedVariable* message = nullptr;
    bool has_match = false;
    for (const NamedVariable& variable : all) {
      if (!is_meant(system, variable.id, pattern.text)) continue;
      if (variable.is_message) {
        message = &variable;
        continue;
      }
      has_match = true;
      if (taken.insert(variable.id).second) selected.push_back(variable.id);
    }
    if (!has_match) fail_without_match(pattern, message, all);
  }
  return selected;
}

}  // namespace stride::io
