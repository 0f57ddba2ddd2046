// From declarations to a resolved system: each component has the description of its unit.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_RESOLVED_SYSTEM_H
#define STRIDE_MASTER_SYSTEM_PLAN_RESOLVED_SYSTEM_H

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/loader/fmu/fmu.h"
#include "master/system/declaration/scenario.h"
#include "master/system/plan/request.h"
#include "master/system/scenario/idle_twins.h"

namespace stride::scenario {

struct ResolvedSystem {
  /// Whose components have their descriptions, and whose terminals are connected. It includes the
  /// idle twins, films and scenes that were requested.
  Scenario scenario;
  std::vector<std::shared_ptr<importer::Fmu>> fmus{};  ///< of each component
  std::vector<IdleTwin> idle_twins{};

  const std::vector<core::ComponentDeclaration>& components() const {
    return scenario.system.components;
  }
  /// By which patterns select components: what selects one selects its twin.
  std::vector<std::string> selection_names() const;
  /// For mistakes that concern the scenario as a whole.
  core::Context of_file() const { return {.where = {scenario.path.string(), 0}}; }
};

/// Finds and describes the units. No library is loaded; only a place on another machine, or a
/// command, is called for the description of its unit. Throws core::Error (Input) for every
/// mistake.
ResolvedSystem resolve(Scenario declared, const ScenarioRequest& request);

/// Whether rules of the annotation, of which a later one takes precedence, allow it to each
/// component.
std::vector<bool> permissions(const ResolvedSystem& system, std::span<const PermissionRule> rules);

}  // namespace stride::scenario

#endif
