#include "units/sensor/power_unit.h"

#include <cmath>
#include <string>

#include <stride/systemc/time.h>

namespace sensor {

using stride::systemc::current_time;
using Mode = Flow::Mode;

PowerUnit::PowerUnit(sc_core::sc_module_name name, const PowerParameters& parameters)
    : sc_module(name),
      parameters_(parameters),
      supply_(parameters),
      voltage_(parameters.initial_voltage),
      good_(parameters.initial_voltage >= parameters.power_on_voltage),
      on_(good_) {
  SC_HAS_PROCESS(PowerUnit);
  SC_METHOD(on_power_event);
  sensitive << field_power << control_unit_current << transceiver_current << adc_current
            << led_current << crossing_timer_.event() << start_up_timer_.event();
}

double PowerUnit::seconds_since_event() const {
  return stride::to_seconds(current_time() - last_event_);
}

double PowerUnit::voltage_now() const {
  return supply_.capacitor(flow_).after(voltage_, seconds_since_event());
}

double PowerUnit::charge_now() const { return parameters_.capacitance * voltage_now(); }

double PowerUnit::terminal_voltage_now() const { return supply_.terminal(flow_, voltage_now()); }

double PowerUnit::rail_voltage_now() const { return supply_.rail(flow_, voltage_now()); }

double PowerUnit::drawn_now() const { return supply_.drawn(flow_, voltage_now()); }
double PowerUnit::intake_now() const { return supply_.intake(flow_, voltage_now()); }
double PowerUnit::load_now() const { return supply_.load(flow_, voltage_now()); }

double PowerUnit::stored_now() const {
  const double start = parameters_.initial_voltage;
  const double now = voltage_now();
  return parameters_.capacitance / 2 * (now - start) * (now + start);
}

EnergyBooks PowerUnit::books_now() const {
  EnergyBooks books = books_;
  books += supply_.books(flow_, voltage_, seconds_since_event());
  return books;
}

PowerReadings PowerUnit::readings_now() const {
  return {charge_now(), terminal_voltage_now(), rail_voltage_now(), drawn_now(), intake_now(),
          load_now(),   stored_now(),           books_now()};
}

PowerReadings PowerUnit::rates_now() const { return supply_.rates(flow_, voltage_now()); }
PowerReadings PowerUnit::curvatures_now() const { return supply_.curvatures(flow_, voltage_now()); }

void PowerUnit::on_power_event() {
  settle();
  arrive();
  take_currents();
  supervise();
  schedule();
  publish();
}

void PowerUnit::settle() {
  books_ = books_now();
  voltage_ = voltage_now();
  last_event_ = current_time();
}

// A crossing's instant was rounded up to a picosecond, and the voltage is rounded, too: that the
// threshold has been reached is known from the event, not from comparing.
void PowerUnit::arrive() {
  at_knee_ = false;
  if (good_ && !on_ && current_time() >= start_up_) on_ = true;
  if (!crossing_ || current_time() < crossing_->instant) return;
  if (crossing_->threshold == Threshold::PowerGood) power_good();
  if (crossing_->threshold == Threshold::BrownOut) brown_out();
  at_knee_ = crossing_->threshold == Threshold::Knee;
}

void PowerUnit::take_currents() {
  if (!(field_power.read() >= 0)) {
    const std::string found = std::to_string(field_power.read());
    SC_REPORT_ERROR("field_power", ("it is " + found + " W, expected 0 or more").c_str());
  }
  Flow flow = supply_.flow(field_power.read(), currents(), voltage_);
  if (flow.same_currents(flow_)) {
    flow.mode = flow_.mode;
    if (at_knee_) flow.mode = Supply::after_knee(flow_.mode);
  }
  at_knee_ = false;
  flow_ = flow;
}

Currents PowerUnit::currents() const {
  if (!on_) return {};
  return {control_unit_current.read(), transceiver_current.read(), adc_current.read(),
          led_current.read()};
}

void PowerUnit::supervise() {
  if (good_ && terminal() <= parameters_.brown_out_voltage) {
    brown_out();
    take_currents();
  }
  if (!good_ && terminal() >= parameters_.power_on_voltage) power_good();
}

void PowerUnit::power_good() {
  good_ = true;
  start_up_ = current_time() + stride::duration_from_seconds(parameters_.start_up_delay);
  start_up_timer_.set(start_up_);
}

void PowerUnit::brown_out() {
  good_ = false;
  on_ = false;
  start_up_timer_.cancel();
}

void PowerUnit::schedule() {
  crossing_timer_.cancel();
  crossing_ = next_crossing();
  if (crossing_) crossing_timer_.set(crossing_->instant);
}

std::optional<PowerUnit::Crossing> PowerUnit::next_crossing() const {
  const Relaxation law = supply_.capacitor(flow_);
  const bool rises = law.slope(voltage_) > 0;
  std::optional<Crossing> next;
  const auto consider = [&](Threshold threshold, double target) {
    const double seconds = law.time_to(voltage_, target);
    if (seconds > stride::kMaxSeconds / 2) return;
    const stride::Duration wait(static_cast<stride::Picoseconds>(std::ceil(seconds * 1e12)));
    if (!next || last_event_ + wait < next->instant) next = {threshold, last_event_ + wait};
  };
  const bool ends_rising = flow_.mode == Mode::ConstantCurrent;
  const std::optional<double> knee = supply_.knee(flow_);
  if (knee && rises == ends_rising && (rises ? voltage_ < *knee : voltage_ > *knee)) {
    consider(Threshold::Knee, *knee);
  }
  if (flow_.mode == Mode::ConstantVoltage) return next;
  if (rises && !good_) {
    consider(Threshold::PowerGood,
             supply_.voltage_for_terminal(flow_, parameters_.power_on_voltage));
  }
  if (!rises && good_) {
    consider(Threshold::BrownOut,
             supply_.voltage_for_terminal(flow_, parameters_.brown_out_voltage));
  }
  return next;
}

void PowerUnit::publish() {
  powered.write(on_);
  energy_intake.write(supply_.intake(flow_, voltage_));
  energy_load.write(supply_.load(flow_, voltage_));
  charge.write(parameters_.capacitance * voltage_);
  voltage.write(supply_.rail(flow_, voltage_));
}

}  // namespace sensor
