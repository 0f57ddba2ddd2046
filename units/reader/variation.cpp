#include "units/reader/variation.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace reader {
namespace {

constexpr double kTwoPi = 6.283185307179586;

enum Purpose : std::uint32_t { kTremor = 0, kStart = 1 };

/// Numbers from [0, 1) of one axis for one purpose. The engine and the seeding are those that the
/// C++ standard defines to the bit; its distributions are not, hence the conversion here.
class Uniform {
 public:
  Uniform(std::uint64_t seed, std::size_t axis, Purpose purpose) {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                           static_cast<std::uint32_t>(axis), static_cast<std::uint32_t>(purpose)};
    engine_.seed(sequence);
  }
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

void scale_to(std::vector<double>& amplitudes, double greatest) {
  const auto largest = std::max_element(amplitudes.begin(), amplitudes.end());
  if (largest == amplitudes.end()) return;
  const double now = *largest;
  for (double& amplitude : amplitudes) {
    amplitude = now > 0.0 ? amplitude / now * greatest : greatest;
  }
}

std::vector<double> start_offsets(const Variation& variation) {
  std::vector<double> offsets;
  for (std::size_t axis = 0; axis < variation.start_offset.size(); ++axis) {
    Uniform uniform(variation.seed, axis, kStart);
    offsets.push_back(variation.start_offset[axis] * (2.0 * uniform() - 1.0));
  }
  return offsets;
}

Tremor::Tremor(const Variation& variation) {
  const double band = variation.highest_frequency - variation.lowest_frequency;
  for (std::size_t i = 0; i < variation.tremor.size(); ++i) {
    Uniform uniform(variation.seed, i, kTremor);
    Axis axis{variation.tremor[i] / std::sqrt(static_cast<double>(kSines)), {}};
    for (std::size_t k = 0; k < kSines; ++k) {
      const double share = (static_cast<double>(k) + uniform()) / kSines;
      axis.sines[k].angular_frequency = kTwoPi * (variation.lowest_frequency + band * share);
      axis.sines[k].phase = kTwoPi * uniform();
    }
    axes_.push_back(axis);
  }
}

double Tremor::at(std::size_t axis, stride::Time time) const {
  if (axis >= axes_.size() || axes_[axis].amplitude == 0.0) return 0.0;
  const double seconds = stride::to_seconds(time);
  double sum = 0.0;
  for (const Sine& sine : axes_[axis].sines) {
    sum += std::sin(sine.angular_frequency * seconds + sine.phase);
  }
  return axes_[axis].amplitude * sum;
}

}  // namespace reader
