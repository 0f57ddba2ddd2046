#include "master/algorithm/step_policies/step_policy.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/algorithm/step_policies/step_limits.h"

namespace stride::core {
namespace {

bool varies_steps(const System& system, const RunOptions& options) {
  const StepLimits limits(system, options);
  return !options.step.policy->has_grid ||
         (limits.maximum() && *limits.maximum() < options.step.size.rounded());
}

}  // namespace

void check_step_policy(const System& system, const RunOptions& options) {
  if (options.step.size.is_below_picosecond())
    throw std::invalid_argument("the step size must be positive");
  const StepPolicyType& policy = *options.step.policy;
  std::vector<std::string> rigid;
  std::vector<std::string> final;
  for (const Component& component : system.components()) {
    if (!component.description->can_vary_step) rigid.push_back(component.name);
    if (!component.can_save_state()) final.push_back(component.name);
  }
  if (!rigid.empty() && varies_steps(system, options)) {
    fail_input({},
               fmt::format("these units take steps of one size only: {}; the policy '{}' with "
                           "these step sizes needs various ones",
                           quoted(rigid), policy.name),
               "use the policy 'fixed', with a step no longer than any unit's maximum");
  }
  if (!final.empty() && policy.controls_error) {
    fail_input({},
               fmt::format("these units cannot be rolled back: {}; the policy '{}' has to undo "
                           "steps that were too long",
                           quoted(final), policy.name),
               "run them in processes of their own, whose snapshots roll them back, <stride:Host "
               "components=\"…\" process=\"true\"/>, or use units that can save their state "
               "(canGetAndSetFMUState), or another policy");
  }
}

std::unique_ptr<StepPolicy> make_step_policy(const System& system, const RunOptions& options) {
  check_step_policy(system, options);
  return options.step.policy->create(system, options);
}

}  // namespace stride::core
