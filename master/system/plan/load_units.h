// The units of a scenario, found and described. No library is loaded.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_LOAD_UNITS_H
#define STRIDE_MASTER_SYSTEM_PLAN_LOAD_UNITS_H

#include <memory>
#include <span>
#include <vector>

#include "master/loader/fmu/fmu.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/declaration/scenario.h"
#include "master/system/plan/request.h"

namespace stride::scenario {

/// The FMUs of a scenario's components, in their order; for `complete`, which needs no system. Of
/// units on other machines these are descriptions.
std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario);
/// Likewise, with those that are there already; others are added. `hosts`: of each component.
std::vector<std::shared_ptr<importer::Fmu>> load_fmus(const Scenario& scenario, UnitStore& units,
                                                      std::span<const HostSettings> hosts);

}  // namespace stride::scenario

#endif
