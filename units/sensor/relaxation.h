// A quantity that approaches its equilibrium exponentially, in closed form.
#ifndef STRIDE_UNITS_SENSOR_RELAXATION_H
#define STRIDE_UNITS_SENSOR_RELAXATION_H

namespace sensor {

/// x' = drift - rate x, rate > 0. All functions keep their digits however small or large the rate
/// is compared with the time. Times are in seconds and not negative.
struct Relaxation {
  double drift;
  double rate;  ///< [1/s]

  double slope(double x) const { return drift - rate * x; }

  /// x after `seconds`.
  double after(double start, double seconds) const;

  /// The integrals of x and of its square over the time from `start` on.
  double integral(double start, double seconds) const;
  double integral_of_square(double start, double seconds) const;

  /// When x, now `start`, reaches `target` [s]; infinite if never.
  double time_to(double start, double target) const;
};

}  // namespace sensor

#endif
