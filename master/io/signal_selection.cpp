#include "master/io/signal_selection.h"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "master/core/suggest.h"
#include "master/io/glob.h"

namespace stride::io {
namespace {

struct Candidate {
  core::VariableId id;
  std::string name;
  bool is_message;
};

std::vector<Candidate> candidates(const core::System& system) {
  std::vector<Candidate> found;
  for (std::size_t c = 0; c < system.components().size(); ++c) {
    const auto& variables = system.components()[c].description->variables;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (variables[v].causality == core::Causality::Independent) continue;  // the first column
      const bool is_message = variables[v].type == core::ValueType::Clock ||
                              (variables[v].is_clocked() && !system.is_sampled({c, v}));
      found.push_back({{c, v}, system.full_name({c, v}), is_message});
    }
  }
  for (std::size_t i = 0; i < system.outputs().size(); ++i) {
    const core::VariableId id = system.output_id(i);
    found.push_back({id, system.full_name(id), false});
  }
  return found;
}

[[noreturn]] void fail_without_match(const SignalPattern& pattern, const Candidate* message,
                                     const std::vector<Candidate>& all) {
  if (message != nullptr) {
    core::fail_input({.where = pattern.where},
                     fmt::format("'{}' cannot be recorded as a signal: '{}' belongs to a clock and "
                                 "has a value only when that ticks",
                                 pattern.text, message->name),
                     "each of its messages is in events.csv, without being asked for");
  }
  std::vector<std::string> names;
  for (const Candidate& candidate : all) {
    if (!candidate.is_message) names.push_back(candidate.name);
  }
  core::fail_input({.where = pattern.where},
                   fmt::format("'{}' matches no variable to record", pattern.text),
                   core::suggestion(pattern.text, names));
}

std::vector<core::VariableId> all_outputs(const core::System& system) {
  std::vector<core::VariableId> outputs;
  for (const Candidate& candidate : candidates(system)) {
    const bool is_output = system.variable(candidate.id).causality == core::Causality::Output;
    if (is_output && !candidate.is_message) outputs.push_back(candidate.id);
  }
  return outputs;
}

}  // namespace

bool matches_signal(const core::System& system, core::VariableId id, const std::string& pattern) {
  const auto is_matched = [&](const std::string& name) {
    return name == pattern || matches_glob(pattern, name);
  };
  if (is_matched(system.full_name(id))) return true;
  const std::vector<std::string>& aliases = system.variable(id).aliases;
  return std::any_of(aliases.begin(), aliases.end(), [&](const std::string& alias) {
    return is_matched(system.prefix(id) + alias);
  });
}

std::vector<core::VariableId> select_signals(const core::System& system,
                                             std::span<const SignalPattern> patterns) {
  if (patterns.empty()) return all_outputs(system);
  const std::vector<Candidate> all = candidates(system);
  std::vector<core::VariableId> selected;
  std::set<core::VariableId> taken;
  for (const SignalPattern& pattern : patterns) {
    const Candidate* message = nullptr;
    bool has_match = false;
    for (const Candidate& candidate : all) {
      if (!matches_signal(system, candidate.id, pattern.text)) continue;
      if (candidate.is_message) {
        message = &candidate;
        continue;
      }
      has_match = true;
      if (taken.insert(candidate.id).second) selected.push_back(candidate.id);
    }
    if (!has_match) fail_without_match(pattern, message, all);
  }
  return selected;
}

}  // namespace stride::io
