// In which order the units of a system make a communication step, so that a step that one of them
// rejects or cuts short can be redone by all.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_STEP_ORDER_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_STEP_ORDER_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"

namespace stride::core {

/// What a unit can do when a step turns out to be too long.
enum class StepRole {
  CanRollBack,     ///< it may stop, or have to go back, and its state can be saved and restored
  MayReturnEarly,  ///< it may return early, and is not rolled back: what it reaches is final
  Follows,         ///< it does not stop on its own, or, without rollback, only by rejecting a step
};

/// The position of one unit in the step order.
struct StepOrderEntry {
  std::size_t component;
  StepRole role;
  bool can_vary_step;
  bool saves_state;             ///< whether its state is saved before each step
  std::string reason;           ///< of its position, human-readable
  bool keeps_own_step = false;  ///< it is called at the ends of its own steps only
  /// Counted from 0. All units of a stage make the same step, possibly at the same time; a stage
  /// begins when the one before it has completed its step.
  std::size_t stage = 0;
  /// Counted from 0 within the stage, the units of a batch side by side. With Gauss-Seidel none of
  /// them feeds another one of them, and they may follow those of the batches before; otherwise a
  /// stage is one batch.
  std::size_t batch = 0;
};

/// Units that can be rolled back come first: if one of them stops, the others go back and follow.
/// Then the one unit, at most, that may stop early and cannot be rolled back: the time that it
/// reaches is final, and the units before it, which go back once more, accept a shorter step where
/// they accepted a longer one (Broman et al., "Determinate Composition of FMUs for Co-Simulation",
/// 2013). Last the units that follow: a unit that never stops goes as far as the others have, and
/// is not saved. Within a role the order is that of the file, which changes no result. With
/// Gauss-Seidel a unit comes after those that feed it; a ring of units that feed each other is cut
/// at the unit that comes first in the file.
///
/// A state is saved only where another unit may stop, and with error-controlled steps always. A
/// snapshot of a process costs more than a unit's own state. One unit needs none: among the units
/// that may stop and have no state of their own, the first of those that may return early, or if
/// none may, of those that may reject a step, where units without snapshots precede those with
/// them. Throws Error (Input) where two units may stop early and neither can be rolled back.
///
/// Components that keep their own steps are the last of their role: they stop nobody, and step when
/// the others have agreed on where they are.
///
/// A unit that cannot be rolled back begins a new stage where the stage before it has a unit that
/// may stop: it must not go further than that one does.
std::vector<StepOrderEntry> step_order(const System& system, const StepPolicyType& policy,
                                       Coupling coupling);

/// The process whose snapshots could roll a unit back. The later, the cheaper.
enum class SnapshotProcess {
  None,  ///< the unit may have no snapshots
  New,   ///< the unit is in the process of stride
  Own,   ///< the unit has a process of its own
};

/// The units that need snapshots, in the order of the file: of the units that may return early and
/// have neither a state nor snapshots all but one; with error-controlled steps all that have
/// neither. `processes`: by component. The one that needs none is, if possible, one with None, else
/// with New. A unit with None is not returned.
std::vector<std::size_t> missing_snapshots(std::span<const ComponentDeclaration> components,
                                           const StepPolicyType& policy,
                                           std::span<const SnapshotProcess> processes);

}  // namespace stride::core

#endif
