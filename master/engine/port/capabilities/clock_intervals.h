#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CLOCK_INTERVALS_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CLOCK_INTERVALS_H

#include "master/engine/model/description.h"
#include "master/engine/port/capability.h"

namespace stride::core {

/// The interval of a time-based clock, as the unit reports it.
struct ClockInterval {
  enum class State { NotYetKnown, Unchanged, Changed };
  State state = State::NotYetKnown;
  Interval interval{};  ///< with Unchanged, the one that the unit gave before
};

/// The intervals of time-based clocks that are not in the description (FMI 3.0, 2.2.8). The
/// variables are clocks of the unit's description.
class ClockIntervals : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::ClockIntervals;

  /// In Initialization Mode it counts from the first tick of a periodic clock, and from the start
  /// to the first tick of another; in Event Mode, after Unit::update_discrete_states(), from the
  /// present instant.
  virtual ClockInterval clock_interval(const Variable& clock) = 0;
  /// From the start to the first tick of a periodic clock; in Initialization Mode only.
  virtual Interval clock_shift(const Variable& clock) = 0;
};

}  // namespace stride::core

#endif
