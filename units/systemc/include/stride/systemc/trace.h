// A device's signals in a VCD file.
#ifndef STRIDE_SYSTEMC_TRACE_H
#define STRIDE_SYSTEMC_TRACE_H

#include <functional>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

#include <stride/systemc/kernel.h>

namespace stride::systemc {

/// What can be traced: names, as patterns choose them, and how.
class SignalList {
 public:
  struct Signal {
    std::string name;       ///< below the device's module
    std::string full_name;  ///< in the file, where the module is a scope
    std::function<void(sc_core::sc_trace_file*, const std::string&)> trace;
  };

  /// Of any type T for which there is an sc_trace(). It must be below a module.
  template <class T, sc_core::sc_writer_policy Policy>
  void add(const sc_core::sc_signal<T, Policy>& signal) {
    add_interface<T>(signal, signal);
  }

  /// What a port of a module is bound to, under the port's name, if it can be traced.
  template <class T>
  void add_port(const sc_core::sc_object& port, const sc_core::sc_signal_in_if<T>& signal) {
    if constexpr (kIsTraced<T>) add_interface(port, signal);
  }

  /// Each sc_signal and sc_clock below the module, of a type that is bool, sc_logic, float, double,
  /// an integer of C++, or an sc_uint, sc_int, sc_bv or sc_lv of up to 64 bits.
  void add_all_within(const sc_core::sc_object& module);

  const std::vector<Signal>& signals() const { return signals_; }

 private:
  /// An enum would be traced through a temporary integer.
  template <class T>
  static constexpr bool kIsTraced =
      std::is_arithmetic_v<T> || std::is_same_v<T, sc_dt::sc_logic> ||
      std::is_base_of_v<sc_dt::sc_uint_base, T> || std::is_base_of_v<sc_dt::sc_int_base, T> ||
      std::is_base_of_v<sc_dt::sc_unsigned, T> || std::is_base_of_v<sc_dt::sc_signed, T> ||
      std::is_base_of_v<sc_dt::sc_bv_base, T> || std::is_base_of_v<sc_dt::sc_lv_base, T>;

  template <class T>
  void add_interface(const sc_core::sc_object& object, const sc_core::sc_signal_in_if<T>& signal) {
    add_named(object, [&signal](sc_core::sc_trace_file* file, const std::string& name) {
      sc_core::sc_trace(file, signal, name);
    });
  }
  template <int... Width>
  void add_if_wide(const sc_core::sc_object& object, std::integer_sequence<int, Width...>);
  template <class... T>
  void add_if_any_of(const sc_core::sc_object& object);
  void add_named(const sc_core::sc_object& object,
                 std::function<void(sc_core::sc_trace_file*, const std::string&)> trace);

  std::vector<Signal> signals_;
};

struct TraceOptions {
  /// Its path; `.vcd` is added where it is missing.
  std::string file;
  std::string signals = "*";  ///< patterns of fnmatch(3), separated by spaces
};

/// A trace file, from the present instant on, which has to be the device's first, until it is
/// destroyed, which comes before the device. Written by SystemC, in units of the device's time
/// resolution (1 ps by default).
///
/// The file's time is SystemC's. Its variable `advanceTime` is the total that has been skipped:
/// what has the stamp #t happened at t + advanceTime, with the value that this has after t.
class Trace {
 public:
  /// Throws std::invalid_argument for a file that cannot be written or is being written by another
  /// device, of this process or another one, and for a pattern that matches no signal.
  Trace(Kernel& kernel, const TraceOptions& options, const SignalList& signals);
  ~Trace();

  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

 private:
  void open(const std::vector<const SignalList::Signal*>& chosen);

  Kernel& kernel_;
  std::string path_;  ///< without `.vcd`
  int lock_ = -1;     ///< the file's descriptor, by which it is locked
  sc_core::sc_trace_file* file_ = nullptr;
};

}  // namespace stride::systemc

#endif
