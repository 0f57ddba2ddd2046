// What a proxy of a unit elsewhere keeps of it in the master.
#ifndef STRIDE_MASTER_LOADER_WIRE_PROXY_RECORD_H
#define STRIDE_MASTER_LOADER_WIRE_PROXY_RECORD_H

#include <cstddef>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include <stride/time.h>

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
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/capability.h"

namespace stride::isolation {

/// What any unit may be capable of; which of it this one is, is known when it is there.
using ProxyCapabilities =
    core::Capabilities<core::ConfigurationMode, core::StateSaving, core::StateSerialization,
                       core::Resetting, core::IdlePromises, core::DirectionalDerivatives,
                       core::ClockIntervals, core::InputsWithinStep, core::MessageText,
                       core::UnitDiagnostics, core::HostDiagnostics, core::ConcurrentSteps>;

/// The simulated time of the unit, and those of its saved states, for errors.
class ProxyTimes {
 public:
  std::optional<Time> now{};

  void select(std::size_t slot) { slot_ = slot; }
  /// The present state is in the slot, or one whose time is not known.
  void note_saved() { note(now); }
  void note_unknown() { note(std::nullopt); }
  void go_back() {
    if (slot_ < saved_.size()) now = saved_[slot_];
  }

 private:
  void note(std::optional<Time> time) {
    if (saved_.size() <= slot_) saved_.resize(slot_ + 1);
    saved_[slot_] = time;
  }

  std::size_t slot_ = 0;
  std::vector<std::optional<Time>> saved_;  ///< by slot
};

/// The function that sets inputs within a step, whose exception waits for the answer of the unit.
class ProxyInputUpdate {
 public:
  void set(core::InputUpdate update) { update_ = std::move(update); }
  bool is_set() const { return static_cast<bool>(update_); }

  /// Whether the inputs are set. The failure is kept.
  bool run(double seconds_into_step) noexcept {
    try {
      if (update_) update_(seconds_into_step);
      return true;
    } catch (...) {
      failure_ = std::current_exception();
      return false;
    }
  }
  /// Does nothing if none was kept.
  void rethrow_failure() {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  core::InputUpdate update_;
  std::exception_ptr failure_;
};

}  // namespace stride::isolation

#endif
