// In which order the units of a system make a communication step, so that a step that one of them
// rejects or cuts short can be redone by all.
#ifndef STRIDE_MASTER_ALGORITHM_STEPPING_STEP_ORDER_H
#define STRIDE_MASTER_ALGORITHM_STEPPING_STEP_ORDER_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "master/algorithm/run_options.h"
#include "master/model/system.h"

namespace stride::core {

/// What a unit can do when a step turns out to be too long.
enum class StepRole {
  CanRollBack,   ///< it may stop, or have to go back, and its state can be saved and restored
  MayStopEarly,  ///< it may return early, and is not rolled back: what it reaches is final
  DoesAsTold,    ///< it does not stop on its own, or, without rollback, only by rejecting a step
};

struct StepPlace {
  std::size_t component;
  StepRole role;
  bool can_vary_step;
  bool saves_state;    ///< whether its state is saved before each step
  std::string reason;  ///< for people: why it stands here
  /// Counted from 0. All units of a stage are asked for the same step, and may make it at the same
  /// time; a stage begins when the one before it has made its step to the end.
  std::size_t stage = 0;
};

/// Those that can be rolled back come first: if one of them stops, the others go back and follow.
/// Then the one unit, at most, that may stop early and cannot be rolled back: what it reaches is
/// final, and the units before it, which go back once more, accept a shorter step where they
/// accepted a longer one (Broman et al., "Determinate Composition of FMUs for Co-Simulation",
/// 2013). Last those that do as they are told; what never stops goes where the others have
/// got, and is not saved. Within a role the order is that of the file, which
/// changes no result; with Gauss-Seidel a unit stands behind those that feed it, as far as they do
/// not feed each other in a ring, which is cut at the unit that comes first in the file.
///
/// A state is saved only where another unit may stop, and with an error-controlled step always. A
/// snapshot of a process, dearer than a unit's own state, is taken only where somebody else has the
/// one place that needs none: among the units that may stop and have no state of their own, the
/// first of those that may return early, or if none may, of those that may reject a step. Who has
/// no snapshots goes before who has, there.
/// Throws Error (Input) where two units may stop early and neither can be rolled back.
///
/// A unit that cannot be rolled back begins a new stage where the stage before it has a unit that
/// may stop: it must not go further than that one does.
std::vector<StepPlace> step_order(const System& system, const StepPolicyType& policy,
                                  Coupling coupling);

/// Those that have to be given snapshots, in the order of the file: of the units that may return
/// early and have neither a state nor snapshots all but one; with error-controlled steps all that
/// have neither. `may_have`: by component, whether it may be given them; who may not is not among
/// those returned, and is the one that can do without, if there is one.
std::vector<std::size_t> missing_snapshots(std::span<const ComponentDeclaration> components,
                                           const StepPolicyType& policy,
                                           const std::vector<bool>& may_have);

}  // namespace stride::core

#endif
