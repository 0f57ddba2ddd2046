// Which components have steps of their own.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_COMPONENT_STEPS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_COMPONENT_STEPS_H

#include <optional>
#include <span>

#include "master/engine/model/system_declaration.h"
#include "master/engine/model/time/interval.h"
#include "master/engine/run/context/run_options.h"
#include "master/system/declaration/run_settings.h"

namespace stride::scenario {

/// The step that a unit declares: that of its DefaultExperiment, else its fixed internal one.
std::optional<core::Interval> declared_step(const core::UnitDescription& unit);

/// The step of its own that each component gets (core::Component::own_step). `set`: those that are
/// set for single components, in their order. `options` have the step of the run;
/// `is_size_set`: the user has set that.
///
/// A unit that takes steps of one size only, and has none set, keeps the step of the run where the
/// user has set that, else the one that it declares. It needs none of its own where all components
/// make the same steps of one size. The others have none, unless the points of some are between
/// those of the run's step, which is then theirs.
ComponentSteps choose_component_steps(std::span<const core::ComponentDeclaration> components,
                                      ComponentSteps set, const core::RunOptions& options,
                                      bool is_size_set);

}  // namespace stride::scenario

#endif
