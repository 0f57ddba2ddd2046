// Short names of the capabilities that a test's unit must have.
#ifndef STRIDE_TESTS_MASTER_ALGORITHM_UNIT_CAPABILITIES_H
#define STRIDE_TESTS_MASTER_ALGORITHM_UNIT_CAPABILITIES_H

#include "master/algorithm/capabilities/clock_intervals.h"
#include "master/algorithm/capabilities/concurrent_steps.h"
#include "master/algorithm/capabilities/configuration_mode.h"
#include "master/algorithm/capabilities/directional_derivatives.h"
#include "master/algorithm/capabilities/host_diagnostics.h"
#include "master/algorithm/capabilities/idle_promises.h"
#include "master/algorithm/capabilities/inputs_within_step.h"
#include "master/algorithm/capabilities/message_text.h"
#include "master/algorithm/capabilities/resetting.h"
#include "master/algorithm/capabilities/state_saving.h"
#include "master/algorithm/capabilities/state_serialization.h"
#include "master/algorithm/capabilities/steps_in_a_row.h"
#include "master/algorithm/capabilities/unit_diagnostics.h"
#include "master/algorithm/unit.h"

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
