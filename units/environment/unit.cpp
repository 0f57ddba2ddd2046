// The sensor's thermal environment as an FMU.
#include <algorithm>

#include <stride/unit.h>

#include "units/environment/model.h"

namespace {

// far below what a sensor resolves; the power's share of the former is deadband R
constexpr double kTemperatureTolerance = 1e-3;  // [K]
constexpr double kPowerDeadband = 1e-5;         // [W]

}  // namespace

class Environment : public stride::Unit {
 public:
  Environment() {
    auto& info = describe("Thermal environment: the sensor's case in ambient air");
    info.promises_idle = true;
    info.split_invariant = true;
    input("absorbed_power", absorbed_power_)
        .unit("W")
        .deadband(kPowerDeadband)
        .description("heat that the case absorbs");
    output("temperature", temperature_)
        .unit("degC")
        .depends_on({})
        .derivative(rate_)
        .tolerance(kTemperatureTolerance)
        .description("temperature of the case");
    output("ambient_temperature", ambient_temperature_)
        .unit("degC")
        .depends_on({})
        .derivative(ambient_rate_)
        .tolerance(kTemperatureTolerance)
        .description("temperature of the air around it");
    parameter("ambient.mean", p_.ambient_mean)
        .unit("degC")
        .min(-273.15)
        .description("mean ambient temperature");
    parameter("ambient.drift.amplitude", p_.drift_amplitude)
        .unit("K")
        .min(0)
        .description("amplitude of the ambient temperature's sinusoidal drift");
    parameter("ambient.drift.period", p_.drift_period)
        .unit("s")
        .range(1e-9, stride::kMaxSeconds)
        .description("period of the drift, which begins at its mean and rises");
    parameter("case.heat_capacity", p_.heat_capacity)
        .unit("J/K")
        .min(0)
        .description("heat capacity of the case");
    parameter("case.thermal_resistance", p_.thermal_resistance)
        .unit("K/W")
        .min(0)
        .description("resistance from the case to the air");
    parameter("case.initial_temperature", p_.initial_temperature)
        .unit("degC")
        .min(-273.15)
        .description("temperature of the case at the start");
    state(rate_, ambient_rate_);
  }

  void initialize(stride::Time start) override {
    case_ = environment::SensorCase(p_);
    temperature_ = p_.initial_temperature;
    show(start);
  }

  void step(stride::Step& step) override {
    temperature_ = case_.temperature_after(step.from(), step.to(), temperature_, absorbed_power_);
    show(step.to());
  }

  // always: how long depends on how straight the temperatures run
  stride::Time idle_until(stride::Time now) const override {
    const auto of_case = case_.case_tangent_holds_for(
        {now, temperature_, rate_, absorbed_power_, kPowerDeadband}, tolerance_of(temperature_));
    const auto of_air = case_.ambient_tangent_holds_for(tolerance_of(ambient_temperature_));
    return stride::later(now, std::min(of_case, of_air));
  }

  // a state may come from an instance with other parameters
  void load_state(stride::StateReader&) override { case_ = environment::SensorCase(p_); }

 private:
  void show(stride::Time now) {
    rate_ = case_.temperature_rate(now, temperature_, absorbed_power_);
    ambient_temperature_ = case_.ambient_temperature(now);
    ambient_rate_ = case_.ambient_rate(now);
  }

  environment::Parameters p_;
  environment::SensorCase case_;
  double absorbed_power_ = 0.0;
  double temperature_ = 0.0;
  double ambient_temperature_ = 0.0;
  double rate_ = 0.0;          // of the temperature [K/s]
  double ambient_rate_ = 0.0;  // of the air's
};

STRIDE_UNIT(Environment)
