#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_IDLE_PROMISES_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_IDLE_PROMISES_H

#include <span>

#include <stride/time.h>

#include "master/engine/model/description.h"
#include "master/engine/port/capability.h"

namespace stride::core {

/// The unit can skip its own idle time in one step and announces how long it will be idle
/// (docs/idle.md). Call order: {enable_idle_skipping(), set_idle_tolerances()} before
/// Unit::enter_initialization(); the others in Step Mode, where a step or Event Mode has just ended
/// and the unit has its inputs.
class IdlePromises : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::IdlePromises;

  /// The unit may skip its idle time, and promises `max_skip` at most; Duration::max() is no limit.
  virtual void enable_idle_skipping(Duration max_skip) = 0;
  /// How far Float64 outputs may be from their tangents meanwhile, in their units of measure: one
  /// tolerance for each output. Those that are not named keep the tolerance of their description.
  virtual void set_idle_tolerances(std::span<const ValueReference> outputs,
                                   std::span<const double> tolerances) = 0;
  /// The instant before which the unit need not be called, while its inputs stay within their
  /// deadbands and none of its clocks is set. A time not after the current one is not a promise;
  /// Time::min() if skipping is not enabled.
  virtual Time idle_until() = 0;
  /// The first derivatives of Float64 outputs that have a tolerance, in their units of measure per
  /// second, arrays element by element; 0 where there is none (Variable::has_derivative).
  virtual void get_derivatives(std::span<const ValueReference> outputs,
                               std::span<double> derivatives) = 0;
};

}  // namespace stride::core

#endif
