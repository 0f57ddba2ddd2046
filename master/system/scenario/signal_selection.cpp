#include "master/system/scenario/signal_selection.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"
#include "master/engine/model/system/unknown_variable.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::scenario {
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
    if (variable.is_signal) names.push_back(variable.name);
  }
  core::fail_input({.where = pattern.where},
                   fmt::format("'{}' matches no variable to record", pattern.text),
                   core::suggestion(pattern.text, names));
}

/// Whether it is a connector of a system in the outermost one, which repeats other values.
bool is_inner(const core::System& system, core::VariableId id) {
  return system.is_output(id) && system.outputs()[id.variable].is_inner;
}

std::vector<core::VariableId> all_outputs(const core::System& system) {
  std::vector<core::VariableId> outputs;
  for (const NamedVariable& variable : named_variables(system)) {
    const bool is_output = system.variable(variable.id).causality == core::Causality::Output;
    if (is_output && variable.is_signal && !is_inner(system, variable.id)) {
      outputs.push_back(variable.id);
    }
  }
  return outputs;
}

[[noreturn]] void fail_without_match(const core::System& system,
                                     std::span<const core::VariableId> recorded,
                                     const PlotPattern& plot, const SignalPattern& pattern) {
  std::vector<std::string> names;
  for (const core::VariableId id : recorded) names.push_back(system.full_name(id));
  core::fail_input({.where = pattern.where},
                   fmt::format("the plot '{}' names '{}', which matches no signal that is recorded",
                               plot.title, pattern.text),
                   core::suggestion(pattern.text, names));
}

/// The place of each recorded variable in the record.
using RecordedPlaces = std::map<core::VariableId, std::size_t>;

RecordedPlaces places_of(std::span<const core::VariableId> recorded) {
  RecordedPlaces places;
  for (std::size_t i = 0; i < recorded.size(); ++i) places.emplace(recorded[i], i);
  return places;
}

/// Adds the columns of what the pattern matches, in the order of the record; returns whether that
/// is anything.
bool add_matches(const core::System& system, const RecordedPlaces& recorded,
                 const std::vector<const NamedVariable*>& meant, std::set<core::VariableId>& taken,
                 recorders::Plot& plot) {
  std::map<std::size_t, core::VariableId> matches;
  for (const NamedVariable* variable : meant) {
    const auto place = recorded.find(variable->id);
    if (place != recorded.end()) matches.emplace(place->second, variable->id);
  }
  for (const auto& [place, id] : matches) {
    if (!taken.insert(id).second) continue;
    for (std::size_t i = 0; i < system.variable(id).size; ++i) {
      plot.signals.push_back(recorders::column_name(system, id, i));
    }
  }
  return !matches.empty();
}

/// Calls miss(plot, pattern) for a pattern that matches nothing.
template <class Miss>
std::vector<recorders::Plot> matching_plots(const core::System& system,
                                            std::span<const core::VariableId> recorded,
                                            std::span<const PlotPattern> patterns, Miss&& miss) {
  std::vector<recorders::Plot> plots;
  if (patterns.empty()) return plots;
  const VariableFinder finder(system);
  const RecordedPlaces places = places_of(recorded);
  for (const PlotPattern& wanted : patterns) {
    recorders::Plot& plot = plots.emplace_back(recorders::Plot{wanted.title, {}});
    std::set<core::VariableId> taken;
    for (const SignalPattern& pattern : wanted.signals) {
      const auto meant = finder.meant(pattern.text, pattern.where);
      if (!add_matches(system, places, meant, taken, plot)) miss(wanted, pattern);
    }
  }
  return plots;
}

}  // namespace

std::vector<NamedVariable> named_variables(const core::System& system) {
  std::vector<NamedVariable> found;
  for (std::size_t c = 0; c < system.components().size(); ++c) {
    const auto& variables = system.components()[c].description->variables;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (variables[v].causality == core::Causality::Independent) continue;  // the first column
      found.push_back({{c, v}, system.full_name({c, v}), system.is_signal({c, v})});
    }
  }
  for (std::size_t i = 0; i < system.outputs().size(); ++i) {
    const core::VariableId id = system.output_id(i);
    found.push_back({id, system.full_name(id), true});
  }
  return found;
}

bool is_meant(const core::System& system, core::VariableId id, const std::string& pattern) {
  if (core::means(pattern, system.full_name(id))) return true;
  const std::vector<std::string>& aliases = system.variable(id).aliases;
  return std::any_of(aliases.begin(), aliases.end(), [&](const std::string& alias) {
    return core::means(pattern, system.prefix(id) + alias);
  });
}

VariableFinder::VariableFinder(const core::System& system)
    : system_(system), all_(named_variables(system)) {
  for (const NamedVariable& variable : all_) {
    by_name_[variable.name].push_back(&variable);
    for (const std::string& alias : system.variable(variable.id).aliases) {
      by_name_[system.prefix(variable.id) + alias].push_back(&variable);
    }
  }
}

std::vector<const NamedVariable*> VariableFinder::meant(const std::string& pattern,
                                                        const core::Location& where) const {
  if (!core::is_glob(pattern)) {
    const auto found = by_name_.find(pattern);
    if (found == by_name_.end()) return {};
    for (const NamedVariable* variable : found->second) {
      if (system_.is_output(variable->id)) continue;
      const core::Component& component = system_.components()[variable->id.component];
      const std::string name = pattern.substr(system_.prefix(variable->id).size());
      core::check_unambiguous({where, component.name, name, {}}, *component.description);
    }
    return found->second;
  }
  std::vector<const NamedVariable*> found;
  for (const NamedVariable& variable : all_) {
    if (is_meant(system_, variable.id, pattern)) found.push_back(&variable);
  }
  return found;
}

std::vector<core::VariableId> select_signals(const core::System& system,
                                             std::span<const SignalPattern> patterns) {
  if (patterns.empty()) return all_outputs(system);
  const VariableFinder finder(system);
  std::vector<core::VariableId> selected;
  std::set<core::VariableId> taken;
  for (const SignalPattern& pattern : patterns) {
    const NamedVariable* message = nullptr;
    bool has_match = false;
    for (const NamedVariable* variable : finder.meant(pattern.text, pattern.where)) {
      if (!variable->is_signal) {
        message = variable;
        continue;
      }
      has_match = true;
      if (taken.insert(variable->id).second) selected.push_back(variable->id);
    }
    if (!has_match) fail_without_match(pattern, message, finder.all());
  }
  return selected;
}

std::vector<recorders::Plot> select_plots(const core::System& system,
                                          std::span<const core::VariableId> recorded,
                                          std::span<const PlotPattern> patterns) {
  return matching_plots(system, recorded, patterns,
                        [&](const PlotPattern& plot, const SignalPattern& pattern) {
                          fail_without_match(system, recorded, plot, pattern);
                        });
}

std::vector<recorders::Plot> remaining_plots(const core::System& system,
                                             std::span<const core::VariableId> recorded,
                                             std::span<const PlotPattern> patterns) {
  std::vector<recorders::Plot> plots =
      matching_plots(system, recorded, patterns, [](const PlotPattern&, const SignalPattern&) {});
  std::erase_if(plots, [](const recorders::Plot& plot) { return plot.signals.empty(); });
  return plots;
}

}  // namespace stride::scenario
