// One SystemC simulation among others in the same process.
#ifndef STRIDE_UNITS_SYSTEMC_KERNEL_H
#define STRIDE_UNITS_SYSTEMC_KERNEL_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <systemc>
#include <utility>

#include <stride/time.h>

#include "units/systemc/scope.h"

namespace stride::systemc {

/// A device reported an error, threw, or called sc_stop. The message names the process and the
/// simulated time. The simulation cannot go on.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A simulation context of its own, with its own time, objects and processes. Any number may live
/// side by side and be advanced in any order and from any thread; the kernel is locked meanwhile.
///
/// Call order: construct; make the modules inside within(); initialize(); advance() as often as
/// wanted; destroy the modules inside within(). Device does the first two and the last of these.
class Kernel {
 public:
  /// Receives what the device reports as info or warning. Nothing is printed.
  using Log = std::function<void(sc_core::sc_severity, const std::string&)>;

  explicit Kernel(Log log = {});
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

  /// Ends elaboration and runs the processes until they rest at time 0.
  void initialize();

  /// Runs all that happens up to and including the instant `to`, and returns it. If the device
  /// calls sc_pause and `may_stop_early` is set, time stops there and that instant is returned; all
  /// that happens at it has happened.
  Time advance(Time to, bool may_stop_early = false);

  /// The time reached, rounded down to a picosecond.
  Time now() const;

  /// When the device does something by itself next, if nothing comes from outside.
  std::optional<Time> next_event();

  /// Ends all threads of the device, so that what lives on their stacks is destroyed. To be called
  /// before the modules are destroyed. The kernel cannot be advanced afterwards.
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
  };

  static void handle(const sc_core::sc_report& report, const sc_core::sc_actions& actions);
  static std::string describe(const sc_core::sc_report& report);
  [[noreturn]] void fail(const std::string& message);
  void require_usable() const;
  void settle();
  void require_not_stopped();

  static Kernel* active_;  ///< the one in whose Entry the kernel is; guarded by the kernel's lock

  Log log_;
  std::unique_ptr<sc_core::sc_simcontext> context_;
  std::uint64_t ticks_ = 1;
  bool initialized_ = false;
  std::string failure_;
};

}  // namespace stride::systemc

#endif
