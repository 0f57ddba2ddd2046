// A clock that is stopped while it is not needed.
#ifndef STRIDE_UNITS_SENSOR_GATED_CLOCK_H
#define STRIDE_UNITS_SENSOR_GATED_CLOCK_H

#include <systemc>

#include <stride/time.h>

namespace sensor {

/// The oscillator runs from power-on; the gate passes its edges while `enable` is set. Rising edges
/// come at whole periods after power-on, so gating changes no edge that is passed. While the gate
/// is closed there are no kernel events. A clock without a gate goes on while the device sleeps;
/// its edges keep their phase over skips of whole periods.
class GatedClock : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_in<bool> enable{"enable"};
  sc_core::sc_out<bool> clock{"clock"};

  /// The half period is rounded to a picosecond.
  GatedClock(sc_core::sc_module_name name, double frequency, bool gating);

  bool gating() const { return gating_; }
  stride::Duration period() const { return 2 * half_period_; }

 private:
  void run();
  void open();
  void tick_after(stride::Duration delay);
  void close();

  stride::Duration half_period_;
  bool gating_;
  sc_core::sc_event tick_{"tick"};
  stride::Time power_on_;
  sc_core::sc_time next_edge_;  ///< in SystemC's time: skips are whole periods
  bool was_powered_ = false;
  bool open_ = false;
  bool level_ = false;
};

}  // namespace sensor

#endif
