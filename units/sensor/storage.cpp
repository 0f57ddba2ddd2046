#include "units/sensor/storage.h"

#include <cmath>
#include <limits>

namespace sensor {

Storage::Storage(double capacitance, double leakage_resistance)
    : capacitance_(capacitance), rate_(2 / (leakage_resistance * capacitance)) {}

double Storage::energy(double voltage) const { return capacitance_ * voltage * voltage / 2; }
double Storage::voltage(double energy) const { return std::sqrt(2 * energy / capacitance_); }
double Storage::charge(double energy) const { return capacitance_ * voltage(energy); }
double Storage::leakage(double energy) const { return rate_ * energy; }

double Storage::after(double start, double power, double seconds) const {
  return start + (power / rate_ - start) * -std::expm1(-rate_ * seconds);
}

double Storage::time_to(double start, double target, double power) const {
  if (start == target) return 0;
  const double slope = power - rate_ * target;  // when it gets there
  const bool reached = (target - start) * slope > 0;
  if (!reached) return std::numeric_limits<double>::infinity();
  return std::log1p(rate_ * (target - start) / slope) / rate_;
}

}  // namespace sensor
