// When a world has come to rest.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_REST_H
#define STRIDE_UNITS_MUJOCO_WORLD_REST_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include <stride/time.h>

namespace mujoco_world {

/// Of every degree of freedom, hinges and slides alike.
struct RestLimits {
  double speed = 1e-5;                      ///< [rad/s] or [m/s]
  double acceleration = 1e-3;               ///< [rad/s²] or [m/s²]
  stride::Duration window{20'000'000'000};  ///< for which they have to stay below [ps]

  bool operator==(const RestLimits& other) const {
    return speed == other.speed && acceleration == other.acceleration && window == other.window;
  }
};

/// What is seen of a world at a grid point.
struct Motion {
  const double* speeds;         ///< of the degrees of freedom
  const double* accelerations;  ///< likewise
  const double* sensors;        ///< all numbers
  double fastest_activation;    ///< the greatest rate of an actuator's activation, 0 or more
  std::uint64_t contacts;       ///< a number that differs where other geoms touch
};

/// Looks at a world from grid point to grid point. It is at rest where for a whole window
///
/// - no speed and no acceleration was above its limit,
/// - what touches what did not change, and
/// - the speeds did not grow: none in the window's second half was above the highest of the first,
///   unless it is below what is noise.
///
/// From then on, while the controls stay, the speeds and accelerations of the window's second half
/// are taken for what will not be exceeded; the sensors, for not drifting faster than in it. That
/// is so where a world settles or creeps; where it stands at an unstable equilibrium, so near to it
/// that the speeds are noise, it would fall in the end, and is taken for resting.
class RestDetector {
 public:
  RestDetector() = default;
  /// `timestep` [ps] is that of the grid. Throws std::invalid_argument if a limit is not positive.
  RestDetector(const RestLimits& limits, stride::Duration timestep, std::size_t degrees_of_freedom,
               std::size_t sensor_numbers);

  /// Forgets what was seen.
  void restart();
  /// Returns whether the window that ends here was one of rest.
  bool observe(const Motion& motion);

  // Of the second half of the window that ended with the last observe(), where it was one of rest.
  double speed(std::size_t degree) const { return speeds_[degree]; }
  double acceleration(std::size_t degree) const { return accelerations_[degree]; }
  double sensor_low(std::size_t number) const { return sensor_low_[number]; }
  double sensor_high(std::size_t number) const { return sensor_high_[number]; }
  double half_window() const;  ///< how long its second half was [s]

  std::size_t state_size() const;
  void save(double* block) const;
  void restore(const double* block);

 private:
  bool is_quiet(const Motion& motion) const;
  void begin_half();
  void note(const Motion& motion);

  RestLimits limits_;
  stride::Duration timestep_{};
  std::uint64_t half_ = 1;  // grid steps
  std::uint64_t seen_ = 0;  // grid steps, up to 2 half_
  std::uint64_t contacts_ = 0;
  double earlier_speed_ = 0;                    // the highest of the first half
  std::vector<double> speeds_, accelerations_;  // the highest ones of the present half
  std::vector<double> sensor_low_, sensor_high_;
};

}  // namespace mujoco_world

#endif
