#include "master/engine/run/step_policies/step_policy.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/run/step_policies/step_limits.h"

namespace stride::core {
namespace {

bool varies_steps(const System& system, const RunOptions& options) {
  const StepLimits limits(system, options);
  return !options.step.policy->has_grid || limits.are_below(options.step.size);
}

void check_own_step(const Component& component) {
  if (!component.own_step) return;
  const auto& maximum = component.description->maximum_step;
  if (component.own_step->is_below_picosecond())
    throw std::invalid_argument("a component's step must be positive");
  if (!maximum || component.own_step->rounded() <= maximum->rounded()) return;
  fail_input({{}, component.name, {}, {}},
             fmt::format("its own step of {} s is longer than its unit's maximum of {} s",
                         to_text(*component.own_step), to_text(*maximum)),
             "give it a shorter one");
}

/// A unit without a state has snapshots with error control, unless something forbids them.
std::string rollback_hint(const System& system) {
  const std::string others =
      "use the policy 'fixed' or 'event-driven', or units that can save their state "
      "(canGetAndSetFMUState)";
  const bool can_all = std::ranges::all_of(system.components(), [](const Component& component) {
    return component.can_save_state() || component.description->allows_snapshots;
  });
  if (!can_all) return others;
  return "let snapshots of their processes roll them back: leave process=\"false\" and "
         "snapshots=\"false\" of their <stride:Host> out; or " +
         others;
}

}  // namespace

void check_step_policy(const System& system, const RunOptions& options) {
  if (options.step.size.is_below_picosecond())
    throw std::invalid_argument("the step size must be positive");
  const StepPolicyType& policy = *options.step.policy;
  std::vector<std::string> rigid;
  std::vector<std::string> final;
  for (const Component& component : system.components()) {
    check_own_step(component);
    const bool is_rigid = !component.description->can_vary_step && !component.keeps_own_step();
    if (is_rigid) rigid.push_back(component.name);
    if (!component.can_save_state()) final.push_back(component.name);
  }
  if (!rigid.empty() && varies_steps(system, options)) {
    fail_input(
        {},
        fmt::format("these units take steps of one size only: {}; the policy '{}' with "
                    "these step sizes needs various ones",
                    quoted(rigid), policy.name),
        "use the policy 'fixed', with a step no longer than any unit's maximum, or give these "
        "units a step of their own, <stride:Step components=\"…\" size=\"…\"/>");
  }
  if (!final.empty() && policy.controls_error) {
    fail_input({},
               fmt::format("these units cannot be rolled back: {}; the policy '{}' has to undo "
                           "steps that were too long",
                           quoted(final), policy.name),
               rollback_hint(system));
  }
}

std::unique_ptr<StepPolicy> make_step_policy(const System& system, const RunOptions& options) {
  check_step_policy(system, options);
  return options.step.policy->create(system, options);
}

}  // namespace stride::core
