// A clock that stands still when nobody needs it.
#ifndef STRIDE_UNITS_SENSOR_GATED_CLOCK_H
#define STRIDE_UNITS_SENSOR_GATED_CLOCK_H

#include <systemc>

#include <stride/time.h>

namespace sensor {

/// The oscillator runs from power-on; the gate passes its edges while `enable` is set. Rising edges
/// come at whole periods after power-on, so gating changes no edge that is passed. While the gate
/// is closed there are no kernel events.
class GatedClock : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_in<bool> enable{"enable"};
  sc_core::sc_out<bool> clock{"clock"};

  /// The half period is rounded to a picosecond.
  GatedClock(sc_core::sc_module_name name, double frequency, bool gating);

 private:
  void run();
  void open();
  void close();

  stride::Duration half_period_;
  bool gating_;
  sc_core::sc_event tick_{"tick"};
  stride::Time power_on_;
  stride::Time next_edge_;
  bool was_powered_ = false;
  bool open_ = false;
  bool level_ = false;
};

}  // namespace sensor

#endif
