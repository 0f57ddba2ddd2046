// The capacitor's energy under constant power and leakage, in closed form.
#ifndef STRIDE_UNITS_SENSOR_STORAGE_H
#define STRIDE_UNITS_SENSOR_STORAGE_H

namespace sensor {

/// A capacitor C with a leakage resistance R in parallel. With a constant power p going in,
/// E' = p - V^2 / R and E = C V^2 / 2 give E' = p - k E with k = 2 / (R C), which is linear.
class Storage {
 public:
  Storage(double capacitance, double leakage_resistance);

  double energy(double voltage) const;  ///< [J]
  double voltage(double energy) const;  ///< [V]
  double charge(double energy) const;   ///< [C]
  double leakage(double energy) const;  ///< [W]

  /// The energy after `seconds` of constant power [W], from `start` [J].
  double after(double start, double power, double seconds) const;

  /// When the energy, now `start`, reaches `target` under constant power [s]; infinite if never.
  double time_to(double start, double target, double power) const;

 private:
  double capacitance_;
  double rate_;  ///< k [1/s]
};

}  // namespace sensor

#endif
