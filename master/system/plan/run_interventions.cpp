#include "master/system/plan/run_interventions.h"

#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/time_text.h"
#include "master/engine/model/system/known_names.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/system/plan/run_steps.h"
#include "master/system/scenario/branches.h"

namespace stride::scenario {
namespace {

/// Whether they are ends of steps of this component.
void check_instants(const InterventionScope& scope, std::size_t component,
                    const core::Intervention& intervention) {
  const StepGrids grids(scope.resolved.components(), scope.options);
  const core::ComponentDeclaration& rigid = scope.resolved.components()[component];
  for (const Time time : {intervention.from, intervention.until.value_or(intervention.from)}) {
    if (grids.grid_of(component).has(time)) continue;
    core::fail_input({rigid.where, rigid.name, {}, {}},
                     fmt::format("the unit takes steps of one size only, and none of {} s ends at "
                                 "{} s, the instant of an intervention on '{}'",
                                 core::to_text(grids.step_of(component)), core::to_text(time),
                                 scope.system.full_name(intervention.id)),
                     "choose a multiple of the step for it");
  }
}

/// A unit that takes steps of one size only cannot have one that ends in between.
void check_instants(const InterventionScope& scope,
                    std::span<const core::Intervention> interventions) {
  for (std::size_t i = 0; i < scope.system.components().size(); ++i) {
    const core::Component& component = scope.system.components()[i];
    if (component.description->can_vary_step) continue;
    const bool is_alone = component.keeps_own_step();
    if (!is_alone && !scope.options.step.policy->has_grid) continue;
    for (const core::Intervention& intervention : interventions) {
      if (!is_alone || intervention.id.component == i) check_instants(scope, i, intervention);
    }
  }
}

}  // namespace

std::vector<InterventionDeclaration> requested_interventions(const core::System& system,
                                                             const std::string& alone,
                                                             const ScenarioRequest& request) {
  std::vector<InterventionDeclaration> declared = request.interventions;
  const auto parse_all = [&](std::span<const std::string> texts, auto& parse) {
    if (texts.empty()) return;
    const core::KnownNames names(system, alone);
    for (const std::string& text : texts) declared.push_back(parse(text, names));
  };
  parse_all(request.set_at, parse_set_at);
  parse_all(request.forces, parse_force);
  parse_all(request.drops, parse_drop);
  parse_all(request.delays, parse_delay);
  parse_all(request.corruptions, parse_corrupt);
  for (const BranchReference& branch : request.branches) {
    const std::vector<InterventionDeclaration> further = find_branch(branch).interventions;
    declared.insert(declared.end(), further.begin(), further.end());
  }
  return declared;
}

std::vector<core::Intervention> resolve_interventions(
    const InterventionScope& scope, std::vector<InterventionDeclaration> further) {
  const auto& own = scope.resolved.scenario.annotation.interventions;
  further.insert(further.begin(), own.begin(), own.end());
  auto resolved = resolve_interventions(scope.system, further,
                                        {scope.options.start, scope.latest, scope.stop_hint});
  check_instants(scope, resolved);
  return resolved;
}

void add_interventions_of_twins(std::span<const IdleTwin> twins,
                                std::vector<core::Intervention>& interventions) {
  const std::size_t count = interventions.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const IdleTwin& pair : twins) {
      if (interventions[i].id.component != pair.unit) continue;
      core::Intervention of_twin = interventions[i];
      of_twin.id.component = of_twin.clock.component = pair.twin;
      interventions.push_back(std::move(of_twin));
    }
  }
}

}  // namespace stride::scenario
