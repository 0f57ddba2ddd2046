// The names by which people choose variables of a system.
#ifndef STRIDE_MASTER_SCENARIO_SIGNAL_NAMES_H
#define STRIDE_MASTER_SCENARIO_SIGNAL_NAMES_H

#include <string>
#include <vector>

#include "master/algorithm/observer.h"
#include "master/model/system.h"

namespace stride::io {

struct NamedVariable {
  core::VariableId id;
  std::string name;  ///< "component.variable", or that of an output of the system
  /// It has a value only when a clock ticks: a clock, or what belongs to a triggered one.
  bool is_message = false;
};

/// All but the time, in the order of the system.
std::vector<NamedVariable> named_variables(const core::System& system);

/// Whether the pattern, a name or a glob, stands for the variable, by its name or an alias of it.
bool is_meant(const core::System& system, core::VariableId id, const std::string& pattern);

}  // namespace stride::io

#endif
