#include "units/mujoco_world/robot/reach.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "units/mujoco_world/hooks.h"

namespace mujoco_world {
namespace {

constexpr int kIterations = 300;
constexpr int kStarts = 60;
constexpr double kDamping = 1e-3;      // of the squared singular values [m²]
constexpr double kLongestStep = 0.2;   // of a joint [rad] or [m]
constexpr double kPlaceError = 1e-5;   // [m]
constexpr double kTurnError = 1e-4;    // [rad]
constexpr double kUnlimited = 3.1416;  // how far a joint without a range goes [rad] or [m]

std::array<double, 3> z_axis(const mjData& data, int site) {
  const double* rows = data.site_xmat + 9 * site;
  return {rows[2], rows[5], rows[8]};
}

double longest_move(const std::vector<double>& from, const std::vector<double>& to) {
  double longest = 0;
  for (std::size_t i = 0; i < to.size(); ++i)
    longest = std::max(longest, std::abs(to[i] - from[i]));
  return longest;
}

/// Even in [0, 1), the same on each machine.
double fraction(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

std::string describe(const mjModel& model, int geom) {
  const char* const name = geom < 0 ? nullptr : mj_id2name(&model, mjOBJ_GEOM, geom);
  if (name && *name) return "'" + std::string(name) + "'";
  return geom < 0 ? "a flexible body"
                  : "'" + name_of(model, mjOBJ_BODY, model.geom_bodyid[geom]) + "'";
}

}  // namespace

Reach::Reach(const std::filesystem::path& folder, const std::string& site,
             const std::string& target)
    : model_(load_model(find_scene(folder))),
      catalogue_(list(*model_)),
      data_(guarded([&] { return mj_makeData(model_.get()); })),
      site_(find_site(site)),
      target_(find_site(target)) {
  list_servos();
  start();
}

int Reach::find_site(const std::string& name) const {
  std::string names;
  for (const Site& site : catalogue_.sites) {
    if (site.name == name) return site.id;
    names += (names.empty() ? "'" : ", '") + site.name + "'";
  }
  throw std::runtime_error("there is no site '" + name +
                           "'; the named sites are: " + (names.empty() ? "none" : names));
}

void Reach::list_servos() {
  for (const Actuator& actuator : catalogue_.actuators) {
    if (actuator.unit != "rad" && actuator.unit != "m") continue;
    const int joint = model_->actuator_trnid[2 * actuator.id];
    Servo servo{
        actuator.id, actuator.control, joint, model_->jnt_qposadr[joint], model_->jnt_dofadr[joint],
        -kUnlimited, kUnlimited};
    if (model_->jnt_limited[joint]) {
      servo.low = model_->jnt_range[2 * joint];
      servo.high = model_->jnt_range[2 * joint + 1];
    }
    if (actuator.range) {  // of the length, which a gear of -1 turns round
      const double gear = model_->actuator_gear[6 * actuator.id];
      const auto [low, high] =
          std::minmax({gear * actuator.range->first, gear * actuator.range->second});
      servo.low = std::max(servo.low, low);
      servo.high = std::min(servo.high, high);
    }
    servos_.push_back(servo);
  }
  if (servos_.empty()) {
    throw std::runtime_error(
        "no joint has a position servo with gear 1, so nothing can be moved: add <actuator>"
        "<position joint=\"…\" kp=\"…\"/></actuator> to the scene");
  }
}

void Reach::start() {
  const int key = mj_name2id(model_.get(), mjOBJ_KEY, "start");
  if (key >= 0) {
    mj_resetDataKeyframe(model_.get(), data_.get(), key);
  } else {
    mj_resetData(model_.get(), data_.get());
  }
  for (const Servo& servo : servos_) start_.push_back(data_->qpos[servo.position]);
}

void Reach::put(const std::vector<double>& angles) {
  for (std::size_t i = 0; i < servos_.size(); ++i) data_->qpos[servos_[i].position] = angles[i];
  mj_kinematics(model_.get(), data_.get());
  mj_comPos(model_.get(), data_.get());
}

/// What is left to go [m], and to turn [rad], as a rotation vector in the world.
std::array<double, 6> Reach::residual(double distance) const {
  const auto to = z_axis(*data_, target_);
  const auto from = z_axis(*data_, site_);
  std::array<double, 6> left{};
  double turn[3];
  const std::array<double, 3> wanted{-to[0], -to[1], -to[2]};
  mju_cross(turn, from.data(), wanted.data());
  const double sine = mju_norm3(turn);
  const double angle = std::atan2(sine, mju_dot3(from.data(), wanted.data()));
  for (std::size_t k = 0; k < 3; ++k) {
    left[k] = data_->site_xpos[3 * target_ + static_cast<int>(k)] + distance * to[k] -
              data_->site_xpos[3 * site_ + static_cast<int>(k)];
    // where both point the same way any axis does
    left[3 + k] = sine > 1e-9 ? turn[k] * angle / sine : (angle > 1 && k == 0 ? angle : 0);
  }
  return left;
}

Reach::Miss Reach::miss(double distance) const {
  const auto left = residual(distance);
  return {mju_norm3(left.data()), mju_norm3(left.data() + 3)};
}

/// What the site does, place over turn, per unit of each servo's joint: 6 rows. A turn about its
/// own axis does not count.
std::vector<double> Reach::jacobian() const {
  const auto nv = static_cast<std::size_t>(model_->nv);
  std::vector<double> place(3 * nv), turn(3 * nv), rows(6 * servos_.size());
  mj_jacSite(model_.get(), data_.get(), place.data(), turn.data(), site_);
  const auto normal = z_axis(*data_, site_);
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const auto column = static_cast<std::size_t>(servos_[i].velocity);
    double about = 0;
    for (std::size_t k = 0; k < 3; ++k) about += normal[k] * turn[k * nv + column];
    for (std::size_t k = 0; k < 3; ++k) {
      rows[k * servos_.size() + i] = place[k * nv + column];
      rows[(3 + k) * servos_.size() + i] = turn[k * nv + column] - about * normal[k];
    }
  }
  return rows;
}

/// The damped least-squares step: J' (J J' + damping)^-1 left.
std::vector<double> Reach::step(const std::array<double, 6>& left) const {
  const std::vector<double> rows = jacobian();
  const int count = static_cast<int>(servos_.size());
  std::array<double, 36> square{};
  mju_mulMatMatT(square.data(), rows.data(), rows.data(), 6, count, 6);
  for (std::size_t k = 0; k < 6; ++k) square[7 * k] += kDamping;
  mju_cholFactor(square.data(), 6, 0);
  std::array<double, 6> weights{};
  mju_cholSolve(weights.data(), square.data(), left.data(), 6);
  std::vector<double> step(servos_.size());
  mju_mulMatTVec(step.data(), rows.data(), weights.data(), 6, count);
  return step;
}

/// From `angles` to a pose from which no step leads nearer, or for as long as is worth it.
void Reach::improve(double distance, std::vector<double>& angles) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    put(angles);
    const auto left = residual(distance);
    if (mju_norm3(left.data()) < kPlaceError / 10 && mju_norm3(left.data() + 3) < kTurnError / 10) {
      return;
    }
    const std::vector<double> moves = step(left);
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      angles[i] = std::clamp(angles[i] + std::clamp(moves[i], -kLongestStep, kLongestStep),
                             servos_[i].low, servos_[i].high);
    }
  }
  put(angles);
}

/// From `angles` through the poses of all distances; false if one of them is out of reach.
bool Reach::follow(const std::vector<double>& distances, std::vector<double> angles, Way& way) {
  const std::vector<double>* before = &start_;
  for (const double distance : distances) {
    improve(distance, angles);
    const Miss miss = this->miss(distance);
    if (miss.place > kPlaceError || miss.turn > kTurnError) {
      note_miss(distance, miss, way.poses.size());
      return false;
    }
    way.length += longest_move(*before, angles);
    guarded([&] { mj_collision(model_.get(), data_.get()); });
    way.contacts += data_->ncon > 0;
    way.poses.push_back(angles);
    before = &way.poses.back();
  }
  return true;
}

/// Kept is what the way that came farthest could not reach, and of these the one that came nearest.
void Reach::note_miss(double distance, const Miss& miss, std::size_t reached) {
  const double amount = miss.place + miss.turn;
  if (!nearest_.empty() &&
      std::tie(farthest_, least_miss_) <= std::tuple(-static_cast<int>(reached), amount)) {
    return;
  }
  farthest_ = -static_cast<int>(reached);
  least_miss_ = amount;
  nearest_ = "a distance of " + std::to_string(distance) +
             " m is out of reach: the nearest pose misses it by " + std::to_string(miss.place) +
             " m and " + std::to_string(miss.turn) +
             " rad; move the target, turn a site whose z axis points away, or widen the joints' "
             "ranges";
}

std::vector<Pose> Reach::solve(const std::vector<double>& distances) {
  std::mt19937_64 random(1);
  std::optional<Way> best;
  nearest_.clear();
  for (int attempt = 0; attempt < kStarts; ++attempt) {
    std::vector<double> angles = start_;
    for (std::size_t i = 0; attempt > 0 && i < angles.size(); ++i) {
      const double low = std::max(servos_[i].low, -kUnlimited);
      const double high = std::min(servos_[i].high, kUnlimited);
      angles[i] = low + fraction(random) * std::max(0.0, high - low);
    }
    Way way;
    way.poses.reserve(distances.size());
    if (!follow(distances, angles, way)) continue;
    if (!best || std::tie(way.contacts, way.length) < std::tie(best->contacts, best->length)) {
      best = std::move(way);
    }
  }
  if (!best) throw std::runtime_error(nearest_);
  std::vector<Pose> poses;
  for (const auto& angles : best->poses) {
    put(angles);
    poses.push_back(pose());
  }
  return poses;
}

/// The pose that put() left, and the commands whose forces balance it: a servo's force is gain *
/// command + b0 + b1 * length at rest (MuJoCo documentation, XML reference, "actuator/general").
Pose Reach::pose() {
  Pose pose;
  pose.contacts = contacts();
  mju_zero(data_->qvel, static_cast<int>(model_->nv));
  mju_zero(data_->qacc, static_cast<int>(model_->nv));
  guarded([&] { mj_inverse(model_.get(), data_.get()); });
  for (const Servo& servo : servos_) {
    const double gear = model_->actuator_gear[6 * servo.actuator];
    const double* gain = model_->actuator_gainprm + mjNGAIN * servo.actuator;
    const double* bias = model_->actuator_biasprm + mjNBIAS * servo.actuator;
    const double force = data_->qfrc_inverse[servo.velocity] / gear;
    const double length = gear * data_->qpos[servo.position];
    data_->ctrl[servo.control] = (force - bias[0] - bias[1] * length) / gain[0];
    const double* limits = model_->actuator_forcerange + 2 * servo.actuator;
    if (model_->actuator_forcelimited[servo.actuator] && (force < limits[0] || force > limits[1])) {
      pose.overload.push_back(name_of(*model_, mjOBJ_JOINT, servo.joint));
    }
  }
  pose.positions.assign(data_->qpos, data_->qpos + model_->nq);
  pose.commands.assign(data_->ctrl, data_->ctrl + model_->nu);
  return pose;
}

std::vector<std::string> Reach::contacts() const {
  guarded([&] { mj_collision(model_.get(), data_.get()); });
  std::set<std::string> pairs;
  for (int i = 0; i < data_->ncon; ++i) {
    const auto [first, second] = api::touching_geoms(data_->contact[i]);
    const auto names = std::minmax({describe(*model_, first), describe(*model_, second)});
    pairs.insert(names.first + " and " + names.second);
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace mujoco_world
