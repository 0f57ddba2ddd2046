// Which variables of a system are recorded.
#ifndef STRIDE_MASTER_SCENARIO_SIGNAL_SELECTION_H
#define STRIDE_MASTER_SCENARIO_SIGNAL_SELECTION_H

#include <span>
#include <vector>

#include "master/algorithm/observer.h"
#include "master/model/system.h"
#include "master/scenario/annotation.h"

namespace stride::io {

/// The variables whose "component.variable" matches a pattern: in the order of the patterns, for
/// each pattern in that of the system, each variable once. Without patterns all outputs.
///
/// Clocks and what belongs to a clock have no value at communication points; a glob passes over
/// them. Throws core::Error (Input) for a pattern that matches nothing else, naming what is near.
std::vector<core::VariableId> select_signals(const core::System& system,
                                             std::span<const SignalPattern> patterns);

}  // namespace stride::io

#endif
