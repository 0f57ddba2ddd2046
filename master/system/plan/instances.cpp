#include "master/system/plan/instances.h"

#include <cstddef>
#include <string>
#include <utility>

#include "master/engine/run/step_policies/step_policy.h"
#include "master/loader/network/remote_unit.h"
#include "master/loader/process/hosted_unit.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/system/plan/run_steps.h"

namespace stride::scenario {
namespace {

importer::InstanceOptions instance_options(const RunPlan& plan, std::size_t component,
                                           const std::filesystem::path& results,
                                           const volatile std::sig_atomic_t* interrupted) {
  const core::ComponentDeclaration& declared = plan.scenario().system.components[component];
  importer::InstanceOptions options;
  options.log = [log = plan.log()](const auto&... message) { log->write(message...); };
  options.debug_logging = true;  // the log's level decides what is shown
  options.early_return_allowed = declared.early_return_allowed;
  options.intermediate_update = plan.options().sets_inputs_in_steps();
  options.where = declared.where;
  if (declared.own_step || plan.options().step.policy->has_grid)
    options.step = StepGrids(plan.scenario().system.components, plan.options()).step_of(component);
  options.interrupted = interrupted;
  if (!results.empty()) options.results = recorders::unit_folder(results, declared.name);
  options.description = plan.system().components()[component].description;
  return options;
}

}  // namespace

std::vector<std::unique_ptr<core::Unit>> instantiate(
    const RunPlan& plan, const std::filesystem::path& results,
    const volatile std::sig_atomic_t* interrupted) {
  const auto& components = plan.system().components();
  const auto& fmus = plan.fmus();
  const auto& hostings = plan.hostings();
  // a unit may change the working folder
  const std::filesystem::path folder =
      results.empty() ? results : std::filesystem::absolute(results);
  std::vector<std::unique_ptr<core::Unit>> units(components.size());
  // processes first: they are forked from this one, which has loaded no unit's library yet; and
  // before them links, so that machines are awaited together
  std::vector<remote::RemoteUnit*> remote_units;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!hostings[i] || !hostings[i]->remote) continue;
    auto unit = std::make_unique<remote::RemoteUnit>(
        *hostings[i]->remote, fmus[i], components[i].name,
        instance_options(plan, i, folder, interrupted), hostings[i]->options);
    remote_units.push_back(unit.get());
    units[i] = std::move(unit);
  }
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!hostings[i] || units[i]) continue;
    isolation::HostOptions host = hostings[i]->options;
    importer::InstanceOptions options = instance_options(plan, i, folder, interrupted);
    if (!folder.empty()) host.writable.push_back(options.results);
    units[i] =
        isolation::instantiate(fmus[i], components[i].name, std::move(options), std::move(host));
  }
  for (remote::RemoteUnit* const unit : remote_units) unit->instantiate();
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i]) continue;
    importer::InstanceOptions options = instance_options(plan, i, folder, interrupted);
    options.process = plan.process();
    units[i] = fmus[i]->instantiate(components[i].name, std::move(options));
  }
  return units;
}

}  // namespace stride::scenario
