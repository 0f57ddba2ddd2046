// When a run pauses.
#ifndef STRIDE_MASTER_ENGINE_RUN_PAUSES_H
#define STRIDE_MASTER_ENGINE_RUN_PAUSES_H

#include <optional>
#include <stdexcept>

#include <stride/time.h>

#include "master/engine/run/run_control.h"

namespace stride::core {

/// Asks the control of a run, if it has one, for its pauses, and makes them.
class Pauses {
 public:
  void set_control(RunControl& control) { control_ = &control; }

  /// The run is at its first communication point, or at the one at which it goes on.
  void begin(Time now) { choose(now); }
  /// Whether make() may have something to do: one comparison where nothing is to come.
  bool may_be_due(Time now) const { return now >= may_be_due_from_; }
  /// From when on it may be so.
  Time may_be_due_from() const { return may_be_due_from_; }
  /// At a communication point: those that are due. `next_target()` returns the target of the next
  /// step, or the least time where there is none.
  template <class NextTarget>
  void make(Time now, NextTarget&& next_target) {
    while (next_ && (next_->before ? next_target() : now) >= next_->time) {
      paused([&] { control_->on_pause(now); });
      choose(now);
    }
  }
  void interrupt(Time now) {
    if (control_ != nullptr) paused([&] { control_->on_interruption(now); });
  }

  /// Throws std::logic_error where there is no pause now.
  void check_paused() const {
    if (!is_paused_) throw std::logic_error("the run is not in a pause");
  }

 private:
  /// A pause before a time depends on the step that follows, so it may be due at any point.
  void choose(Time now) {
    next_ = control_ != nullptr ? control_->next(now) : std::nullopt;
    may_be_due_from_ = !next_ ? Time::max() : next_->before ? Time::min() : next_->time;
  }

  template <class Action>
  void paused(Action&& action) {
    struct Scope {
      bool& is_paused;
      ~Scope() { is_paused = false; }
    };
    const Scope scope{is_paused_ = true};
    action();
  }

  RunControl* control_ = nullptr;
  std::optional<Pause> next_;
  Time may_be_due_from_ = Time::max();
  bool is_paused_ = false;
};

}  // namespace stride::core

#endif
