#include "units/sensor/power_unit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "units/systemc/time.h"

namespace sensor {

using stride::systemc::current_time;
using stride::systemc::to_sc_time;

PowerUnit::PowerUnit(sc_core::sc_module_name name, const PowerParameters& parameters)
    : sc_module(name),
      parameters_(parameters),
      storage_(parameters.capacitance, parameters.leakage_resistance),
      energy_(storage_.energy(parameters.initial_voltage)),
      on_(parameters.initial_voltage >= parameters.power_on_voltage) {
  SC_HAS_PROCESS(PowerUnit);
  SC_METHOD(on_power_event);
  sensitive << field_power << control_unit_current << transceiver_current << adc_current
            << led_current << crossing_;
}

double PowerUnit::seconds_since_event() const {
  return stride::to_seconds(current_time() - last_event_);
}

double PowerUnit::energy_now() const {
  if (full_) return energy_;
  return storage_.after(energy_, intake_ - load_, seconds_since_event());
}

double PowerUnit::charge_now() const { return storage_.charge(energy_now()); }
double PowerUnit::voltage_now() const { return storage_.voltage(energy_now()); }

double PowerUnit::charging_current_now() const {
  constexpr double kLeastVoltage = 1e-3;  // below it a constant power means a current without bound
  if (full_ || voltage_now() < kLeastVoltage) return 0;
  return (intake_ - load_ - storage_.leakage(energy_now())) / voltage_now();
}

EnergyBooks PowerUnit::books_now() const {
  const double seconds = seconds_since_event();
  EnergyBooks books = books_;
  books.intake += intake_ * seconds;
  books.load += load_ * seconds;
  books.leakage += (intake_ - load_) * seconds - (energy_now() - energy_);
  return books;
}

void PowerUnit::on_power_event() {
  settle_books();
  arrive();
  take_powers();
  schedule();
  publish();
}

void PowerUnit::settle_books() {
  books_ = books_now();
  energy_ = energy_now();
  last_event_ = current_time();
}

// the instant was rounded up to a picosecond; the threshold itself is taken as reached
void PowerUnit::arrive() {
  if (next_ == Threshold::kNone || current_time() < next_instant_) return;
  energy_ = threshold_energy(next_);
  if (next_ == Threshold::kPowerOn) on_ = true;
  if (next_ == Threshold::kBrownOut) on_ = false;
  if (next_ == Threshold::kFull) full_ = true;
}

void PowerUnit::take_powers() {
  const double current = control_unit_current.read() + transceiver_current.read() +
                         adc_current.read() + led_current.read();
  if (!(field_power.read() >= 0)) {
    const std::string found = std::to_string(field_power.read());
    SC_REPORT_ERROR("field_power", ("it is " + found + " W, expected 0 or more").c_str());
  }
  const double rectified = parameters_.rectifier_efficiency * field_power.read();
  load_ = on_ ? current * parameters_.supply_voltage / parameters_.regulator_efficiency : 0;

  const double needed = load_ + storage_.leakage(energy_);
  full_ = energy_ >= threshold_energy(Threshold::kFull) && rectified >= needed;
  intake_ = full_ ? needed : rectified;
}

double PowerUnit::threshold_energy(Threshold threshold) const {
  switch (threshold) {
    case Threshold::kPowerOn:
      return storage_.energy(parameters_.power_on_voltage);
    case Threshold::kBrownOut:
      return storage_.energy(parameters_.brown_out_voltage);
    case Threshold::kFull:
      return storage_.energy(parameters_.maximum_voltage);
    case Threshold::kNone:
      break;
  }
  return energy_;
}

void PowerUnit::schedule() {
  crossing_.cancel();
  next_ = Threshold::kNone;
  if (full_) return;
  const bool rises = intake_ >= load_ + storage_.leakage(energy_);
  if (!rises && !on_) return;
  const Threshold target =
      !rises ? Threshold::kBrownOut : (on_ ? Threshold::kFull : Threshold::kPowerOn);
  const double goal = threshold_energy(target);
  const bool there = rises ? energy_ >= goal : energy_ <= goal;
  const double seconds = there ? 0 : storage_.time_to(energy_, goal, intake_ - load_);
  if (seconds > stride::kMaxSeconds / 2) return;
  next_ = target;
  const stride::Duration wait(static_cast<std::int64_t>(std::ceil(seconds * 1e12)));
  next_instant_ = last_event_ + wait;
  crossing_.notify(to_sc_time(wait));
}

void PowerUnit::publish() {
  powered.write(on_);
  energy_intake.write(intake_);
  energy_load.write(load_);
  charge.write(storage_.charge(energy_));
  voltage.write(storage_.voltage(energy_));
}

}  // namespace sensor
