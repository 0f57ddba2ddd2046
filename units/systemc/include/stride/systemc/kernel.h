// One SystemC simulation among others in the same process.
#ifndef STRIDE_SYSTEMC_KERNEL_H
#define STRIDE_SYSTEMC_KERNEL_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include <stride/systemc/scope.h>
#include <stride/time.h>

namespace stride::systemc {

class Timer;

/// A device reported an error or threw. The message names the process and the simulated time. The
/// simulation cannot go on.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A simulation context of its own, with its own time, objects and processes. Any number may live
/// side by side and be advanced in any order and from any thread; the kernel is locked meanwhile.
///
/// All instants here are true time, which is SystemC's time and what has been skipped; see skip().
///
/// Call order: construct; make the modules inside within(); initialize(); advance() as often as
/// wanted; destroy the modules inside within(). Device does the first two and the last of these.
class Kernel {
 public:
  /// Receives what the device reports as info or warning. Nothing is printed.
  using Log = std::function<void(sc_core::sc_severity, const std::string&)>;

  /// `systemc` is where the caller's SystemC is, by its default argument. Throws std::runtime_error
  /// where that is another copy than this library's, which the loader has taken for one that the
  /// caller's own needs: two kernels would each have a part of the device.
  explicit Kernel(Log log = {}, const void* systemc = &sc_core::sc_curr_simcontext);
  ~Kernel();

  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  /// Calls f in this context; whatever touches modules, ports, events or signals belongs in there.
  /// Throws DeviceError for a report of an error; other exceptions pass.
  template <class Function>
  decltype(auto) within(Function&& f) {
    const Entry entry(*this);
    try {
      return std::forward<Function>(f)();
    } catch (const sc_core::sc_report& report) {
      fail(describe(report));
    }
  }

  /// Keeps a channel that ports of the modules are bound to; it is destroyed with the kernel. To be
  /// made within().
  void own(std::shared_ptr<void> channel) { owned_.push_back(std::move(channel)); }

  /// An event that a clock of the unit's own notifies itself with, before initialize(); those of
  /// sc_clocks are found.
  void add_clock(const sc_core::sc_event& edge);

  /// Ends elaboration and runs the processes until none is left to run at time 0.
  void initialize();

  /// Where the device has called sc_stop: it has finished, and time goes no further. The delta
  /// cycle of the call is complete, the later ones of that instant do not happen.
  std::optional<Time> stopped() const { return stopped_; }

  /// Runs all that happens up to and including the instant `to`, and returns it. If the device
  /// calls sc_pause and `may_stop_early` is set, time stops there and that instant is returned; all
  /// that happens at it has happened. Where it calls sc_stop, that instant is returned.
  Time advance(Time to, bool may_stop_early = false);

  /// The same, but leaves what is due at `to` itself for the next call, so that a pause there is
  /// not overlooked: an instant before `to` is returned for a pause or a stop only.
  Time approach(Time to, bool may_stop_early = false);

  /// The time reached, rounded down to a picosecond.
  Time now() const;

  /// Nothing is left to be done at the time reached.
  bool at_rest() const;

  /// When the device does something by itself next, if nothing comes from outside.
  std::optional<Time> next_event();
  /// When a Timer is due next, after now().
  std::optional<Time> next_timer() const;
  /// The true time at which SystemC notifies something next, timers not counted: the edge of a
  /// clock, a wait(time), an event notified with a delay.
  std::optional<Time> next_notification();
  struct Span {
    Time first;
    Time last;
  };
  /// The same of all notifications that are no edge of a clock. The edges of sc_clocks are known;
  /// where the device has none, its clocks are processes, and what is due within `period` may be an
  /// edge.
  std::optional<Span> unclocked_notifications(Duration period);

  /// Lets time pass in which nothing is simulated: now() moves, SystemC's time does not. Timers
  /// keep their true instants, all other notifications come later by `duration`. To be called at
  /// rest; throws std::logic_error otherwise, or if a timer is due up to the instant reached.
  void skip(Duration duration);
  /// All that has been skipped.
  Duration skipped() const { return skipped_; }
  /// Adds the same to a trace, in units of the device's time resolution. Skips throw
  /// std::out_of_range then where it is beyond SystemC's time.
  void trace_skipped(sc_core::sc_trace_file* file, const char* name);
  /// How many units of the device's time resolution make one picosecond.
  std::uint64_t ticks_per_picosecond() const { return ticks_; }

  /// TLM's global quantum, of which each kernel has its own: 0 s unless the device sets another.
  void set_quantum(Duration quantum);

  /// The kernel in whose context the caller is; none outside of within().
  static Kernel* current() { return active_; }

  /// Writes what has changed at the present instant to SystemC's trace files, which it does by
  /// itself where time goes on from there. No process runs. SystemC's time is one unit of its
  /// resolution further then.
  void write_traces() noexcept;

  /// Ends all threads of the device, so that what lives on their stacks is destroyed; also after a
  /// failure. To be called before the modules are destroyed. The kernel cannot be advanced
  /// afterwards.
  void end_threads() noexcept;

 private:
  /// A scope that also makes this kernel the one whose log is written.
  class Entry {
   public:
    explicit Entry(Kernel& kernel);
    ~Entry();

   private:
    Scope scope_;
    Kernel* previous_;
    sc_core::sc_time outer_quantum_;
  };

  friend class Timer;

  static void handle(const sc_core::sc_report& report, const sc_core::sc_actions& actions);
  std::string describe(const sc_core::sc_report& report) const;
  std::string true_time(const sc_core::sc_time& kernel_time) const;
  [[noreturn]] void fail(const std::string& message);
  void require_usable() const;
  void require_not_before_now(Time to) const;
  void settle();
  bool has_stopped();
  void require_not_stopped();
  void find_clocks();

  void make_alarm();
  void ring();
  void set_alarm();
  void withdraw_alarm();

  sc_core::sc_time to_kernel_time(Time time) const;

  static Kernel* active_;  ///< the one in whose Entry the kernel is; guarded by the kernel's lock

  Log log_;
  std::unique_ptr<sc_core::sc_simcontext> context_;
  std::uint64_t ticks_ = 1;
  std::vector<std::shared_ptr<void>> owned_;
  bool initialized_ = false;
  std::string failure_;
  std::optional<Time> stopped_;
  sc_core::sc_time quantum_;                            ///< while nothing is in its context
  std::vector<const sc_core::sc_event*> clock_events_;  ///< of all clocks, sorted
  Duration skipped_{};
  bool is_traced_ = false;
  sc_dt::uint64 advance_time_ = 0;            ///< skipped_, as it is traced
  std::vector<Timer*> timers_;                ///< in the order of their construction
  std::unique_ptr<sc_core::sc_event> alarm_;  ///< wakes the timers that are due
  Time horizon_{};                            ///< the alarm is set for timers up to here
};

}  // namespace stride::systemc

#endif
