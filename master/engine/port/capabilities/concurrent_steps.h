#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CONCURRENT_STEPS_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_CONCURRENT_STEPS_H

#include <chrono>

#include "master/engine/port/capability.h"
#include "master/engine/port/unit.h"

namespace stride::core {

/// Of a unit that computes elsewhere, such as in a process of its own: while it makes a step the
/// caller does something else.
class ConcurrentSteps : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::ConcurrentSteps;

  /// What goes with a step.
  struct Extras {
    bool saves_state = false;  ///< before the step, with its inputs; see StateSaving
    bool is_timed = false;     ///< step_time() is asked for afterwards
  };

  /// Begins what step(interval, values) does, and does not wait for its end. The values belong to
  /// the unit until finish_step(), which has to follow. After a failure of another unit terminate()
  /// or free() may follow instead: they give the step some time to end, and drop its outcome.
  virtual void begin_step(const StepInterval& interval, const StepValues& values,
                          const Extras& extras) = 0;
  /// Waits for the end of the step, and returns or throws what step() would.
  virtual StepResult finish_step() = 0;
  /// Of the last step, which was timed: from begin_step() until the unit was done, however much
  /// later that was looked at.
  virtual std::chrono::nanoseconds step_time() const = 0;
};

}  // namespace stride::core

#endif
