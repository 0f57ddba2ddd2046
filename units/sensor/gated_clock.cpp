#include "units/sensor/gated_clock.h"

#include "units/systemc/time.h"

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
  if (current_time() < next_edge_) return;
  level_ = !level_;
  clock.write(level_);
  next_edge_ += half_period_;
  tick_.notify(to_sc_time(half_period_));
}

void GatedClock::open() {
  const stride::Duration period = 2 * half_period_;
  const stride::Duration since = current_time() - power_on_;
  next_edge_ = power_on_ + (since / period + 1) * period;
  tick_.notify(to_sc_time(next_edge_ - current_time()));
  open_ = true;
}

void GatedClock::close() {
  tick_.cancel();
  level_ = false;
  clock.write(false);
  open_ = false;
}

}  // namespace sensor
