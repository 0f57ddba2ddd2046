// Short names of the capabilities that a test's unit must have.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_UNIT_CAPABILITIES_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_UNIT_CAPABILITIES_H

#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/unit.h"

namespace stride::tests {

inline core::ConfigurationMode& configuration(core::Unit& unit) {
  return unit.require_capability<core::ConfigurationMode>();
}
inline core::StateSaving& state(core::Unit& unit) {
  return unit.require_capability<core::StateSaving>();
}
inline core::StateSerialization& serialization(core::Unit& unit) {
  return unit.require_capability<core::StateSerialization>();
}
inline core::Resetting& resetting(core::Unit& unit) {
  return unit.require_capability<core::Resetting>();
}
inline core::IdlePromises& idle(core::Unit& unit) {
  return unit.require_capability<core::IdlePromises>();
}
inline core::DirectionalDerivatives& derivatives(core::Unit& unit) {
  return unit.require_capability<core::DirectionalDerivatives>();
}
inline core::ClockIntervals& clocks(core::Unit& unit) {
  return unit.require_capability<core::ClockIntervals>();
}
inline core::InputsWithinStep& inputs_within_step(core::Unit& unit) {
  return unit.require_capability<core::InputsWithinStep>();
}
inline core::MessageText& texts(core::Unit& unit) {
  return unit.require_capability<core::MessageText>();
}
inline core::UnitDiagnostics& diagnostics(core::Unit& unit) {
  return unit.require_capability<core::UnitDiagnostics>();
}
inline core::HostDiagnostics& host_diagnostics(core::Unit& unit) {
  return unit.require_capability<core::HostDiagnostics>();
}

}  // namespace stride::tests

#endif
