#include "units/environment/model.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <stride/tangent.h>

namespace environment {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kAbsoluteZero = -273.15;  // [degC]

void require(bool ok, const std::string& name, double value, const std::string& range) {
  if (ok && std::isfinite(value)) return;
  std::ostringstream message;
  message << name << " is " << value << ": expected " << range;
  throw std::invalid_argument(message.str());
}

const Parameters& checked(const Parameters& p) {
  const std::string above_zero = "a temperature above -273.15 degC";
  const std::string positive = "more than 0";
  require(p.ambient_mean >= kAbsoluteZero, "ambient.mean", p.ambient_mean, above_zero);
  require(p.drift_amplitude >= 0.0, "ambient.drift.amplitude", p.drift_amplitude, "0 or more");
  require(p.drift_period > 0.0 && p.drift_period <= stride::kMaxSeconds, "ambient.drift.period",
          p.drift_period, "more than 0 and at most 1e15 s");
  require(p.heat_capacity > 0.0, "case.heat_capacity", p.heat_capacity, positive);
  require(p.thermal_resistance > 0.0, "case.thermal_resistance", p.thermal_resistance, positive);
  require(p.initial_temperature >= kAbsoluteZero, "case.initial_temperature", p.initial_temperature,
          above_zero);
  return p;
}

}  // namespace

SensorCase::SensorCase(const Parameters& parameters)
    : parameters_(checked(parameters)),
      drift_period_(stride::duration_from_seconds(parameters.drift_period)),
      time_constant_(parameters.thermal_resistance * parameters.heat_capacity) {
  require(drift_period_.count() > 0, "ambient.drift.period", parameters.drift_period,
          "at least a picosecond");
}

double SensorCase::temperature_after(stride::Time from, stride::Time to, double temperature,
                                     double absorbed_power) const {
  const double decay = std::exp(-stride::to_seconds(to - from) / time_constant_);
  const double transient = temperature - driven_temperature(from, absorbed_power);
  return driven_temperature(to, absorbed_power) + transient * decay;
}

double SensorCase::temperature_rate(stride::Time time, double temperature,
                                    double absorbed_power) const {
  const double lost = (temperature - ambient_temperature(time)) / parameters_.thermal_resistance;
  return (absorbed_power - lost) / parameters_.heat_capacity;
}

double SensorCase::ambient_temperature(stride::Time time) const {
  return parameters_.ambient_mean + parameters_.drift_amplitude * std::sin(drift_phase(time));
}

double SensorCase::ambient_rate(stride::Time time) const {
  return parameters_.drift_amplitude * drift_frequency() * std::cos(drift_phase(time));
}

stride::Duration SensorCase::case_tangent_holds_for(const CaseTangent& tangent,
                                                    double tolerance) const {
  const double now = temperature_rate(tangent.time, tangent.temperature, tangent.absorbed_power);
  const double ambient = parameters_.drift_amplitude * drift_frequency();
  const double curvature = (ambient + std::max(std::abs(now), ambient)) / time_constant_;
  const double other_slope = std::abs(now - tangent.rate);
  const double other_power = tangent.deadband * parameters_.thermal_resistance;
  if (other_power < tolerance / 2) {
    return stride::tangent_holds_for(tolerance - other_power, curvature, other_slope);
  }
  return stride::tangent_holds_for(tolerance, curvature,
                                   other_slope + tangent.deadband / parameters_.heat_capacity);
}

stride::Duration SensorCase::ambient_tangent_holds_for(double tolerance) const {
  const double frequency = drift_frequency();
  return stride::tangent_holds_for(tolerance, parameters_.drift_amplitude * frequency * frequency);
}

double SensorCase::drift_frequency() const { return kTwoPi / stride::to_seconds(drift_period_); }

// The particular solution, in which the case has long followed its surroundings: the heating's
// steady rise, and the drift damped and delayed by the first-order lag.
double SensorCase::driven_temperature(stride::Time time, double absorbed_power) const {
  const double rise = absorbed_power * parameters_.thermal_resistance;
  const double lag = drift_frequency() * time_constant_;
  const double phase = drift_phase(time);
  const double drift =
      parameters_.drift_amplitude * (std::sin(phase) - lag * std::cos(phase)) / (1.0 + lag * lag);
  return parameters_.ambient_mean + rise + drift;
}

// whole periods are taken off in integer time, so that the phase stays exact in a long run
double SensorCase::drift_phase(stride::Time time) const {
  const stride::Duration in_period = time.time_since_epoch() % drift_period_;
  return kTwoPi * stride::to_seconds(in_period) / stride::to_seconds(drift_period_);
}

}  // namespace environment
