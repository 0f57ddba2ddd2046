// How inputs change during a step, for units that interpolate them (FMI 2.0, 4.2.1).
#ifndef STRIDE_MASTER_LOADER_FMU_FMI2_INPUT_DERIVATIVES_H
#define STRIDE_MASTER_LOADER_FMU_FMI2_INPUT_DERIVATIVES_H

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <stride/fmi2.h>

namespace stride::importer {

/// The derivatives of inputs at the beginning of a step of h seconds, from samples at 0, h/2 and h:
///
///   f'  = (-3 f(0) + 4 f(h/2) - f(h)) / h
///   f'' = 4 (f(0) - 2 f(h/2) + f(h)) / h²
///
/// which is exact for polynomials up to the second degree, and the inputs are no others. Nothing
/// allocates after the first step.
class InputDerivatives {
 public:
  static constexpr int kSamples = 3;
  /// Where sample k is taken [s].
  static double instant(int k, double step) { return k * step / (kSamples - 1); }

  /// Of sample k = 0, 1, 2, in this order, each with the same inputs in the same order.
  void begin_sample(int k);
  void add(const fmi2ValueReference* inputs, std::span<const double> values);

  /// Computes the derivatives. Those of the second order are left out as long as each is within
  /// the rounding of its samples: not every unit that knows the first knows the second.
  void compute(double step);

  /// What fmi2SetRealInputDerivatives takes, computed last.
  const std::vector<fmi2ValueReference>& references() const { return references_; }
  const std::vector<fmi2Integer>& orders() const { return orders_; }
  const std::vector<fmi2Real>& values() const { return values_; }

 private:
  double second_difference(std::size_t i) const;

  int present_ = 0;
  std::array<std::vector<double>, kSamples> samples_;
  std::vector<fmi2ValueReference> references_;
  std::vector<fmi2Integer> orders_;
  std::vector<fmi2Real> values_;
  bool has_second_ = false;  ///< from when one of them was not 0 first
};

}  // namespace stride::importer

#endif
