// The available step policies.
#ifndef STRIDE_MASTER_ALGORITHM_STEP_POLICIES_STEP_POLICY_TYPE_H
#define STRIDE_MASTER_ALGORITHM_STEP_POLICIES_STEP_POLICY_TYPE_H

#include <array>
#include <memory>
#include <string>

namespace stride::core {

class StepPolicy;
class System;
struct RunOptions;
struct StepOptions;

/// The static properties of a step policy, and its factory. Each is defined in the file of its
/// class.
struct StepPolicyType {
  const char* name;  ///< in scenarios and on the command line
  /// Whether communication points are on a grid of StepOptions::size.
  bool has_grid = false;
  /// Whether StepPolicy::accept() decides on each step by the error of the inputs, so that all
  /// units have to be able to undo a step.
  bool controls_error = false;
  std::unique_ptr<StepPolicy> (*create)(const System& system, const RunOptions& options);
  /// For people: "in steps of 0.01 s".
  std::string (*describe)(const StepOptions& options);
};

extern const StepPolicyType kFixedSteps;
extern const StepPolicyType kEventDrivenSteps;
extern const StepPolicyType kErrorControlledSteps;

/// The policies that scenarios and the command line accept, in the order in which they are listed.
inline constexpr std::array kStepPolicies{&kFixedSteps, &kEventDrivenSteps, &kErrorControlledSteps};

inline const char* name(const StepPolicyType* policy) { return policy->name; }

}  // namespace stride::core

#endif
