#include "master/loader/fmu/fmi2/input_derivatives.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::importer {

void InputDerivatives::begin_sample(int k) {
  present_ = k;
  samples_[static_cast<std::size_t>(k)].clear();
  if (k == 0) references_.clear();
}

void InputDerivatives::add(const fmi2ValueReference* inputs, std::span<const double> values) {
  auto& sample = samples_[static_cast<std::size_t>(present_)];
  sample.insert(sample.end(), values.begin(), values.end());
  if (present_ == 0) references_.insert(references_.end(), inputs, inputs + values.size());
}

/// 0 where it is within rounding.
double InputDerivatives::second_difference(std::size_t i) const {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const double begin = samples_[0][i];
  const double middle = samples_[1][i];
  const double end = samples_[2][i];
  const double difference = begin - 2 * middle + end;
  const double magnitude = std::max({std::abs(begin), std::abs(middle), std::abs(end)});
  return std::isfinite(difference) && std::abs(difference) > kRounding * magnitude ? difference : 0;
}

void InputDerivatives::compute(double step) {
  const std::size_t count = samples_[0].size();
  references_.resize(count);
  orders_.assign(count, 1);
  values_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    // the same as in the header, but exact for a constant and, in a line, without the curvature
    const double rise = samples_[2][i] - samples_[0][i];
    const double slope = (rise - 2 * second_difference(i)) / step;
    values_.push_back(std::isfinite(slope) ? slope : 0);
    has_second_ |= second_difference(i) != 0;
  }
  if (!has_second_) return;
  orders_.resize(2 * count, 2);
  for (std::size_t i = 0; i < count; ++i) {
    references_.push_back(references_[i]);
    values_.push_back(4 * second_difference(i) / (step * step));
  }
}

}  // namespace stride::importer
