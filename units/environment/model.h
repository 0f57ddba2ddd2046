// The warmth around the sensor and in its case.
#ifndef STRIDE_UNITS_ENVIRONMENT_MODEL_H
#define STRIDE_UNITS_ENVIRONMENT_MODEL_H

#include <stride/time.h>

namespace environment {

struct Parameters {
  double ambient_mean = 21.5;         ///< [degC]
  double drift_amplitude = 0.0;       ///< of the ambient temperature around its mean [K]
  double drift_period = 3600.0;       ///< [s]
  double heat_capacity = 5.0;         ///< of the case, C [J/K]
  double thermal_resistance = 20.0;   ///< from the case to the ambient air, R [K/W]
  double initial_temperature = 21.5;  ///< of the case at time 0 [degC]
};

/// A line that begins at the temperature of the case, and the power for which it has been drawn.
struct CaseTangent {
  stride::Time time;      ///< where it begins
  double temperature;     ///< there [degC]
  double rate;            ///< its slope [K/s]
  double absorbed_power;  ///< there [W]
  double deadband;        ///< within which the power stays of this one [W]
};

/// The case as one heat capacity that loses heat through one resistance (Incropera et al.,
/// "Fundamentals of Heat and Mass Transfer", ch. 5, the lumped capacitance method):
///     C dT/dt = P - (T - T_ambient(t)) / R,  T_ambient(t) = mean + amplitude sin(2 pi t / period)
///
/// Each step takes the exact solution for a constant absorbed power P, so that a step may be split
/// anywhere and the result stays the same to rounding.
/// It holds no state: the temperature of the case goes in and comes out.
class SensorCase {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit SensorCase(const Parameters& parameters = {});

  /// The temperature of the case at `to` [degC], from the one at `from` [degC] and a constant
  /// absorbed power in between [W].
  double temperature_after(stride::Time from, stride::Time to, double temperature,
                           double absorbed_power) const;

  /// dT/dt of the case at an instant [K/s].
  double temperature_rate(stride::Time time, double temperature, double absorbed_power) const;

  double ambient_temperature(stride::Time time) const;  ///< [degC]
  double ambient_rate(stride::Time time) const;         ///< its derivative [K/s]

  /// How long the case's temperature stays within `tolerance` [K] of the tangent, while the
  /// absorbed power stays within the deadband.
  ///
  /// The rate obeys RC dT'/dt + T' = dT_ambient/dt, of which the right side is never more than
  /// a = 2 pi amplitude / period; so |T'| <= max(|T'(time)|, a) from then on, and
  /// |T''| <= (a + max(|T'(time)|, a)) / RC. Another power moves the case by deadband R at most, at
  /// the rate deadband / C at most.
  stride::Duration case_tangent_holds_for(const CaseTangent& tangent, double tolerance) const;
  /// Likewise of the ambient temperature, with its own slope: |T''| <= (2 pi / period)^2 amplitude.
  stride::Duration ambient_tangent_holds_for(double tolerance) const;

 private:
  double drift_phase(stride::Time time) const;
  double drift_frequency() const;  // angular [rad/s]
  double driven_temperature(stride::Time time, double absorbed_power) const;

  Parameters parameters_;
  stride::Duration drift_period_;
  double time_constant_;  // R C [s]
};

}  // namespace environment

#endif
