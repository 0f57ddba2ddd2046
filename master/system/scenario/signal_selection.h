// Which variables of a system are recorded, and which of these are drawn together.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_SIGNAL_SELECTION_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_SIGNAL_SELECTION_H

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"
#include "master/observe/recorders/results_folder.h"
#include "master/system/declaration/annotation.h"

namespace stride::scenario {

struct NamedVariable {
  core::VariableId id;
  std::string name;       ///< "component.variable", or that of an output of the system
  bool is_signal = true;  ///< neither a clock nor a message
};

/// All but the time, in the order of the system.
std::vector<NamedVariable> named_variables(const core::System& system);

/// Whether the pattern, a name or a glob, matches the variable, by its name or an alias of it.
bool is_meant(const core::System& system, core::VariableId id, const std::string& pattern);

/// The variables that patterns mean. A plain name is looked up, so many names among many variables
/// take a time in proportion to both.
class VariableFinder {
 public:
  /// The system must outlive it.
  explicit VariableFinder(const core::System& system);
  VariableFinder(const VariableFinder&) = delete;
  VariableFinder& operator=(const VariableFinder&) = delete;

  /// As named_variables() returns them.
  const std::vector<NamedVariable>& all() const { return all_; }
  /// Those for which is_meant() is true, in the order of the system. Throws core::Error (Input) at
  /// `where` for a name that several variables have, which are not the same.
  std::vector<const NamedVariable*> meant(const std::string& pattern,
                                          const core::Location& where) const;

 private:
  const core::System& system_;
  std::vector<NamedVariable> all_;
  std::unordered_map<std::string, std::vector<const NamedVariable*>> by_name_;  ///< and by alias
};

/// The variables whose "component.variable" matches a pattern: in the order of the patterns, for
/// each pattern in that of the system, each variable once. Without patterns all outputs.
///
/// Clocks and what belongs to a clock have no value at communication points; a glob passes over
/// them. Throws core::Error (Input) for a pattern that matches nothing else, naming what is near.
std::vector<core::VariableId> select_signals(const core::System& system,
                                             std::span<const SignalPattern> patterns);

/// What the patterns match of the recorded variables: in the order of a plot's patterns, for each
/// pattern in that of the record, each variable once in a plot. Throws core::Error (Input) for a
/// pattern that matches nothing recorded, naming what is near.
std::vector<recorders::Plot> select_plots(const core::System& system,
                                          std::span<const core::VariableId> recorded,
                                          std::span<const PlotPattern> patterns);

/// Likewise where the user has chosen other signals than the scenario's: what is not recorded is
/// not drawn, and a plot of which nothing is left is left out.
std::vector<recorders::Plot> remaining_plots(const core::System& system,
                                             std::span<const core::VariableId> recorded,
                                             std::span<const PlotPattern> patterns);

}  // namespace stride::scenario

#endif
