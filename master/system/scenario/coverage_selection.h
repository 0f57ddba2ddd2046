// What the coverage of a scenario is of.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_COVERAGE_SELECTION_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_COVERAGE_SELECTION_H

#include <span>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/demand.h"
#include "master/system/declaration/coverage_declaration.h"

namespace stride::scenario {

struct SelectedCoverage {
  std::vector<coverage::GroupDefinition> groups{};
  std::vector<coverage::Demand> demands{};
  std::vector<std::string> notes{};  ///< of inputs for which there can be no automatic point
};

/// The declared groups with the variables of the system, and the checks of them; a glob, and an
/// array that is named as a whole, become a point for each signal and element. A group without
/// points gets automatic ones: the values of the scalar inputs with a range, the words, lengths,
/// sequences and gaps of what it receives, the values and transitions of its Booleans and
/// Enumerations among the outputs. Throws core::Error (Input), which reports all mistakes at once:
/// a name that matches nothing, with the nearest one; a signal without bins; a second group of a
/// component; two points of one name; a bin to ignore that does not exist.
SelectedCoverage select_coverage(const core::System& system,
                                 std::span<const GroupDeclaration> groups,
                                 std::span<const CoveredDeclaration> demands);

}  // namespace stride::scenario

#endif
