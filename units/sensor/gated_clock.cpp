#include "units/sensor/gated_clock.h"

#include <stride/systemc/time.h>

namespace sensor {

using stride::systemc::current_time;
using stride::systemc::to_sc_time;

GatedClock::GatedClock(sc_core::sc_module_name name, double frequency, bool gating)
    : sc_module(name),
      half_period_(stride::duration_from_seconds(0.5 / frequency)),
      gating_(gating) {
  SC_HAS_PROCESS(GatedClock);
  SC_METHOD(run);
  sensitive << powered << enable << tick_;
}

void GatedClock::run() {
  if (powered.read() && !was_powered_) power_on_ = current_time();
  was_powered_ = powered.read();
  const bool wanted = powered.read() && (enable.read() || !gating_);
  if (!wanted) {
    if (open_) close();
    return;
  }
  if (!open_) open();
  if (sc_core::sc_time_stamp() < next_edge_) return;
  level_ = !level_;
  clock.write(level_);
  tick_after(half_period_);
}

void GatedClock::open() {
  const stride::Duration since = current_time() - power_on_;
  tick_after(period() - since % period());
  open_ = true;
}

void GatedClock::tick_after(stride::Duration delay) {
  next_edge_ = sc_core::sc_time_stamp() + to_sc_time(delay);
  tick_.notify(to_sc_time(delay));
}

void GatedClock::close() {
  tick_.cancel();
  level_ = false;
  clock.write(false);
  open_ = false;
}

}  // namespace sensor
