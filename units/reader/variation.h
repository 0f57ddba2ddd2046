// What makes one run differ from the next: a hand that trembles, and where it begins.
#ifndef STRIDE_UNITS_READER_VARIATION_H
#define STRIDE_UNITS_READER_VARIATION_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <stride/time.h>

namespace reader {

/// The same seed gives the same run. The two lists have one number per axis.
struct Variation {
  std::uint64_t seed = 1;
  double lowest_frequency = 4.0;     ///< of the tremor [Hz]
  double highest_frequency = 12.0;   ///< [Hz], more than the lowest
  std::vector<double> tremor;        ///< amplitude [rad], 0 for an axis that does not tremble
  std::vector<double> start_offset;  ///< largest deviation of the first waypoint [rad]
};

/// Scales a list so that its greatest number is `greatest`: each axis keeps its share. A list of
/// zeros becomes a list of `greatest`.
void scale_to(std::vector<double>& amplitudes, double greatest);

/// The deviation of each axis in the first waypoint [rad], uniform within +-start_offset.
std::vector<double> start_offsets(const Variation& variation);

/// A tremor as a function of time and seed alone, so that steps may be cut or taken back anywhere:
///
///     x(t) = A / sqrt(K) * sum over k of sin(2 pi f_k t + p_k),  K = 16
///
/// Spectral representation of a process whose spectrum is flat between the lowest and the highest
/// frequency and zero elsewhere (M. Shinozuka, G. Deodatis, "Simulation of Stochastic Processes by
/// Spectral Representation", Appl. Mech. Rev. 44 (1991)). Each f_k is drawn from the k-th of K
/// equal parts of the band, so the motion does not repeat; the phases p_k are uniform. It has the
/// power of a single sine of amplitude A (its root mean square is A / sqrt(2)), exceeds A now and
/// then, and never A * sqrt(K).
///
/// The default band, 4 to 12 Hz, holds most tremors of the hand (K. Bhatia et al., "Consensus
/// Statement on the Classification of Tremors", Movement Disorders 33 (2018)); the physiological
/// one peaks at 6 to 12 Hz (M. Lakie et al., J. Physiology 593 (2015)).
class Tremor {
 public:
  Tremor() = default;
  explicit Tremor(const Variation& variation);

  /// The deviation of an axis [rad]; 0 for one that is not in the variation.
  double at(std::size_t axis, stride::Time time) const;

 private:
  static constexpr std::size_t kSines = 16;
  struct Sine {
    double angular_frequency;  // [rad/s]
    double phase;              // [rad]
  };
  struct Axis {
    double amplitude;  // of each sine [rad]
    std::array<Sine, kSines> sines;
  };
  std::vector<Axis> axes_;
};

}  // namespace reader

#endif
