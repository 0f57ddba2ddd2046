// The step that a unit was made for.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_OWN_STEP_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_OWN_STEP_H

#include <string>

#include "master/engine/model/description.h"
#include "master/engine/model/time/interval.h"

namespace stride::core {

/// What to do where the unit of a component does not accept a step of this size: the size that it
/// was made for, which is that of its DefaultExperiment, or else its internal one, and how it is
/// set for this component, whatever the steps of the others are. Empty if the unit names none, or
/// this one.
std::string own_step_hint(const std::string& component, const UnitDescription& unit,
                          const Interval& size);

}  // namespace stride::core

#endif
