// From text to declarations: a scenario as its files and the command line have it.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_DECLARED_H
#define STRIDE_MASTER_SYSTEM_PLAN_DECLARED_H

#include <string>
#include <vector>

#include "master/engine/model/system_declaration.h"
#include "master/system/declaration/scenario.h"
#include "master/system/plan/request.h"

namespace stride::scenario {

/// The scenario with the requested swaps and start values; it has a component. Units are found and
/// described only where the names of their variables tell the sides of an option apart. Throws
/// core::Error (Input) for every mistake.
Scenario declare(const ScenarioRequest& request);

ScenarioChanges changes_of(const ScenarioRequest& request);

std::vector<std::string> component_names(const core::SystemDeclaration& system);

}  // namespace stride::scenario

#endif
