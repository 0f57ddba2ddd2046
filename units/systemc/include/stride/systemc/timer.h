// A device's alarm clock: what sc_event::notify(delay) is to a simulation without idle skipping.
#ifndef STRIDE_SYSTEMC_TIMER_H
#define STRIDE_SYSTEMC_TIMER_H

#include <optional>
#include <systemc>

#include <stride/systemc/kernel.h>
#include <stride/time.h>

namespace stride::systemc {

/// An event that is notified at a true instant, however much has been skipped until then. A member
/// of a module: it belongs to the Kernel in which it is constructed, and has to be destroyed before
/// it.
///
/// Processes are sensitive to event(). They run in the first delta cycle of the instant, as with a
/// timed notification; those of several timers of one instant run in the order in which the timers
/// were constructed.
class Timer {
 public:
  /// Throws std::logic_error outside of a Kernel.
  explicit Timer(const char* name);
  ~Timer();

  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  /// Sets it, in the place of what it was set to before. Now is the next delta cycle. Throws
  /// std::invalid_argument for an instant in the past.
  void set(Time at);
  void set_after(Duration delay);
  void cancel();

  /// What it is set to; nothing once it has gone off.
  std::optional<Time> due() const { return due_; }
  const sc_core::sc_event& event() const { return event_; }

 private:
  friend class Kernel;
  void go_off();

  Kernel& kernel_;
  sc_core::sc_event event_;
  std::optional<Time> due_;
};

}  // namespace stride::systemc

#endif
