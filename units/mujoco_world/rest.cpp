#include "units/mujoco_world/rest.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace mujoco_world {
namespace {

constexpr double kNoise = 1e-9;         // a speed in [rad/s] or [m/s] that rounding may make
constexpr double kSteady = 1.0 + 1e-3;  // a creep's speed is not the same to the last bit

void require_positive(const char* name, double value) {
  if (value > 0 && std::isfinite(value)) return;
  throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) +
                              ": expected more than 0");
}

double highest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

// counts go bit by bit into a double of the state block
double as_double(std::uint64_t count) {
  double bits;
  std::memcpy(&bits, &count, sizeof bits);
  return bits;
}
std::uint64_t as_count(double bits) {
  std::uint64_t count;
  std::memcpy(&count, &bits, sizeof count);
  return count;
}

}  // namespace

RestDetector::RestDetector(const RestLimits& limits, stride::Duration timestep,
                           std::size_t degrees_of_freedom, std::size_t sensor_numbers)
    : limits_(limits),
      timestep_(timestep),
      speeds_(degrees_of_freedom),
      accelerations_(degrees_of_freedom),
      sensor_low_(sensor_numbers),
      sensor_high_(sensor_numbers) {
  require_positive("rest.speed", limits.speed);
  require_positive("rest.acceleration", limits.acceleration);
  require_positive("rest.window", stride::to_seconds(limits.window));
  half_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(limits.window / timestep) / 2);
  restart();
}

void RestDetector::restart() {
  seen_ = 0;
  earlier_speed_ = 0;
  begin_half();
}

void RestDetector::begin_half() {
  std::fill(speeds_.begin(), speeds_.end(), 0.0);
  std::fill(accelerations_.begin(), accelerations_.end(), 0.0);
  std::fill(sensor_low_.begin(), sensor_low_.end(), std::numeric_limits<double>::infinity());
  std::fill(sensor_high_.begin(), sensor_high_.end(), -std::numeric_limits<double>::infinity());
}

bool RestDetector::is_quiet(const Motion& motion) const {
  const auto all_below = [](const double* values, std::size_t count, double limit) {
    return std::all_of(values, values + count, [=](double v) { return std::abs(v) <= limit; });
  };
  return motion.fastest_activation <= limits_.speed && motion.contacts == contacts_ &&
         all_below(motion.speeds, speeds_.size(), limits_.speed) &&
         all_below(motion.accelerations, accelerations_.size(), limits_.acceleration);
}

void RestDetector::note(const Motion& motion) {
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    speeds_[i] = std::max(speeds_[i], std::abs(motion.speeds[i]));
    accelerations_[i] = std::max(accelerations_[i], std::abs(motion.accelerations[i]));
  }
  for (std::size_t i = 0; i < sensor_low_.size(); ++i) {
    sensor_low_[i] = std::min(sensor_low_[i], motion.sensors[i]);
    sensor_high_[i] = std::max(sensor_high_[i], motion.sensors[i]);
  }
}

bool RestDetector::observe(const Motion& motion) {
  if (!is_quiet(motion)) {
    contacts_ = motion.contacts;
    restart();
    return false;
  }
  if (seen_ == half_ || seen_ == 2 * half_) {  // what was the second half is the first one now
    seen_ = half_;
    earlier_speed_ = highest(speeds_);
    begin_half();
  }
  note(motion);
  ++seen_;
  return seen_ == 2 * half_ && highest(speeds_) <= std::max(earlier_speed_ * kSteady, kNoise);
}

double RestDetector::half_window() const {
  return static_cast<double>(half_) * stride::to_seconds(timestep_);
}

std::size_t RestDetector::state_size() const {
  return 3 + 2 * speeds_.size() + 2 * sensor_low_.size();
}

void RestDetector::save(double* block) const {
  *block++ = as_double(seen_);
  *block++ = as_double(contacts_);
  *block++ = earlier_speed_;
  for (const auto* values : {&speeds_, &accelerations_, &sensor_low_, &sensor_high_}) {
    block = std::copy(values->begin(), values->end(), block);
  }
}

void RestDetector::restore(const double* block) {
  seen_ = as_count(*block++);
  contacts_ = as_count(*block++);
  earlier_speed_ = *block++;
  for (auto* values : {&speeds_, &accelerations_, &sensor_low_, &sensor_high_}) {
    std::copy_n(block, values->size(), values->begin());
    block += values->size();
  }
}

}  // namespace mujoco_world
