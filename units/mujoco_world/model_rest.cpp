// How a world comes to rest, and how long that may last.
#include <algorithm>
#include <cmath>
#include <vector>

#include <stride/tangent.h>

#include "units/mujoco_world/model.h"

namespace mujoco_world {
namespace {

using stride::Duration;
using stride::tangent_holds_for;
using stride::Time;

/// Differs where other geoms touch: FNV-1a (Fowler, Noll, Vo) over their numbers.
std::uint64_t contacts_of(const mjData& data) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto add = [&](int number) {
    hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x100000001b3U;
  };
  for (int i = 0; i < data.ncon; ++i) {
    const auto [one, other] = api::touching_geoms(data.contact[i]);
    add(one);
    add(other);
  }
  return hash;
}

double fastest_activation(const mjModel& model, const mjData& data) {
  double fastest = 0;
  for (int i = 0; i < model.na; ++i) fastest = std::max(fastest, std::abs(data.act_dot[i]));
  return fastest;
}

}  // namespace

void World::allow_rest(const RestSettings& settings) {
  resting_ = false;
  if (!rest_settings_ || !(rest_settings_->limits == settings.limits)) {
    rest_detector_ = RestDetector(settings.limits, timestep_, static_cast<std::size_t>(model_->nv),
                                  static_cast<std::size_t>(model_->nsensordata));
  }
  rest_settings_ = settings;
}

void World::forbid_rest() {
  resting_ = false;
  rest_settings_.reset();
}

bool World::keeps_inputs() const { return inputs_ == taken_; }

/// At a grid point that was just integrated to. The accelerations, the sensors and the contacts are
/// those of the grid point before it.
void World::look_for_rest() {
  mjData& data = *grid_data_;
  const Motion motion{data.qvel, data.qacc, data.sensordata, fastest_activation(*model_, data),
                      contacts_of(data)};
  if (!rest_detector_.observe(motion) || !keeps_inputs()) return;
  const std::vector<double> velocities(data.qvel, data.qvel + model_->nv);
  std::fill_n(data.qvel, model_->nv, 0.0);
  pose_known_ = sensors_known_ = false;
  const Duration holds = rest_holds_for();
  // shorter than the detection of rest takes, it is not worth it
  const bool is_worth_it = stride::to_seconds(holds) >= 2 * rest_detector_.half_window();
  const std::int64_t steps = std::min(holds, rest_settings_->longest) / timestep_;
  if (!is_worth_it || steps < 1) {
    std::copy(velocities.begin(), velocities.end(), data.qvel);
    pose_known_ = sensors_known_ = false;
    return;
  }
  resting_ = true;
  rest_end_ = stride::later(grid_, steps * timestep_);
}

/// Closes the time without integrating it. What is seen of the world is the same all the time.
void World::rest(Time to) {
  if (!keeps_inputs()) {
    resting_ = false;
    rest_detector_.restart();
    pose_known_ = sensors_known_ = false;
    return;
  }
  now_ = std::min(to, rest_end_);
  grid_ += (now_ - grid_) / timestep_ * timestep_;
  if (now_ == rest_end_) resting_ = false;
}

Duration World::rest_holds_for() const {
  Duration holds = std::min(joints_hold_for(), sensors_hold_for());
  for (std::size_t i = 0; i < catalogue_.sites.size(); ++i) {
    holds = std::min(holds, site_holds_for(i));
  }
  return holds;
}

/// For an output that the resting world shows as it is, and that moves at most so fast.
Duration World::joints_hold_for() const {
  const RestTolerances& tolerances = rest_settings_->tolerances;
  Duration holds = Duration::max();
  for (std::size_t i = 0; i < catalogue_.joints.size(); ++i) {
    const auto degree = static_cast<std::size_t>(catalogue_.joints[i].velocity);
    const double speed = rest_detector_.speed(degree);
    if (speed > tolerances.joint_velocities[i]) return Duration{};
    holds = std::min(holds, tangent_holds_for(tolerances.joint_positions[i],
                                              rest_detector_.acceleration(degree), speed));
  }
  return holds;
}

/// By the site's Jacobian; what it changes while a world rests is of second order.
Duration World::site_holds_for(std::size_t site) const {
  const auto degrees = static_cast<std::size_t>(model_->nv);
  std::vector<double> translation(3 * degrees);
  std::vector<double> rotation(3 * degrees);
  mj_jacSite(model_.get(), &posed(), translation.data(), rotation.data(),
             catalogue_.sites[site].id);
  const auto bound = [&](const std::vector<double>& jacobian, std::size_t row, auto rate) {
    double sum = 0;
    for (std::size_t i = 0; i < degrees; ++i) {
      sum += std::abs(jacobian[row * degrees + i]) * (rest_detector_.*rate)(i);
    }
    return sum;
  };
  Duration holds = Duration::max();
  double turning[2] = {0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    holds = std::min(holds, tangent_holds_for(rest_settings_->tolerances.site_positions[site][k],
                                              bound(translation, k, &RestDetector::acceleration),
                                              bound(translation, k, &RestDetector::speed)));
    turning[0] += bound(rotation, k, &RestDetector::speed);
    turning[1] += bound(rotation, k, &RestDetector::acceleration);
  }
  for (const double tolerance : rest_settings_->tolerances.site_axes[site]) {
    holds = std::min(holds, tangent_holds_for(tolerance, turning[1], turning[0]));
  }
  return holds;
}

/// From where the sensors have been to what the resting world shows is a way, too.
Duration World::sensors_hold_for() const {
  Duration holds = Duration::max();
  if (model_->nsensordata == 0) return holds;
  const mjData& resting = sensed();
  for (std::size_t i = 0; i < static_cast<std::size_t>(model_->nsensordata); ++i) {
    const double low = rest_detector_.sensor_low(i);
    const double high = rest_detector_.sensor_high(i);
    const double shown = resting.sensordata[i];
    const double left = rest_settings_->tolerances.sensors[i] -
                        std::max(std::abs(shown - low), std::abs(shown - high));
    if (!(left >= 0)) return Duration{};
    holds =
        std::min(holds, tangent_holds_for(left, 0, (high - low) / rest_detector_.half_window()));
  }
  return holds;
}

}  // namespace mujoco_world
