#include "units/mujoco_world/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "units/mujoco_world/hooks.h"

namespace mujoco_world {
namespace {

using stride::Duration;
using stride::Time;

Duration read_timestep(const mjModel& model) {
  const Duration timestep = stride::duration_from_seconds(model.opt.timestep);
  if (timestep < Duration(1)) {
    throw std::runtime_error("the world's timestep is " + std::to_string(model.opt.timestep) +
                             " s: expected at least one picosecond in <option timestep>");
  }
  return timestep;
}

/// The index of the first number that is NaN or beyond MuJoCo's limit, -1 if all are well.
int first_bad(const double* values, int count) {
  const auto is_well = [](double value) { return std::abs(value) < mjMAXVAL; };
  const int index = static_cast<int>(std::find_if_not(values, values + count, is_well) - values);
  return index == count ? -1 : index;
}

int joint_of_position(const mjModel& model, int index) {
  const int* first = model.jnt_qposadr;
  return static_cast<int>(std::upper_bound(first, first + model.njnt, index) - first) - 1;
}

// A time goes bit by bit into doubles of the state block: as a value, it would not be exact.
constexpr std::size_t kTime = sizeof(Time::rep) / sizeof(double);
constexpr std::size_t kTimes = 2 * kTime;
constexpr std::size_t kRest = 1 + kTime;  // whether it rests, and until when

void put_time(double* place, Time time) {
  const Time::rep count = time.time_since_epoch().count();
  std::memcpy(place, &count, sizeof count);
}

Time get_time(const double* place) {
  Time::rep count;
  std::memcpy(&count, place, sizeof count);
  return Time(Duration(count));
}

void call_mujoco(void (*function)(const mjModel*, mjData*), const mjModel& model, mjData& data,
                 Time time) {
  try {
    guarded([&] { function(&model, &data); });
  } catch (const std::exception& error) {
    api::clear_stack(&data);
    throw std::runtime_error("MuJoCo failed at " + std::to_string(stride::to_seconds(time)) +
                             " s: " + error.what());
  }
}

// Such sensors read zero where nothing touches; to know that costs less than the forces do.
bool has_only_touch_sensors(const mjModel& model) {
  return std::all_of(model.sensor_type, model.sensor_type + model.nsensor,
                     [](int type) { return type == mjSENS_TOUCH; });
}

}  // namespace

World::World(const std::filesystem::path& folder)
    : model_(load_model(find_scene(folder))),
      catalogue_(list(*model_)),
      contacts_(list_contacts(*model_, find_scene(folder))),
      timestep_(read_timestep(*model_)),
      only_touches_(has_only_touch_sensors(*model_)),
      clearance_(*model_) {
  model_->opt.timestep = stride::to_seconds(timestep_);
  grid_data_ = make_data();
  instant_data_ = make_data();
  inputs_.resize(catalogue_.actuators.size());
  taken_.resize(inputs_.size());
  lamps_.resize(catalogue_.lamps.size());
  fields_.resize(catalogue_.fields.size());
  touching_.resize(contacts_.size());
  scratch_.resize(api::state_size(model_.get(), grid_data_.get()));
  reset(Time{});
}

World::DataPointer World::make_data() const {
  DataPointer data(guarded([&] { return mj_makeData(model_.get()); }));
  if (!data) throw std::runtime_error("MuJoCo could not allocate the world's state");
  return data;
}

void World::reset(Time start, const StartPose& pose) {
  put_at_start(*model_, *grid_data_, pose);
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    inputs_[i] = grid_data_->ctrl[catalogue_.actuators[i].control];
  }
  taken_ = inputs_;
  std::fill(lamps_.begin(), lamps_.end(), 0.0);
  std::fill(fields_.begin(), fields_.end(), 0.0);
  failed_ = false;
  resting_ = false;
  rest_detector_.restart();
  move(start, start);
  look_for_contacts();
}

std::vector<std::string> World::flaws() const { return flaws_of_pose(*model_, collided()); }

void World::set_input(std::size_t actuator, double value) {
  if (!std::isfinite(value)) {
    throw std::invalid_argument("actuator '" + catalogue_.actuators.at(actuator).name +
                                "' was given " + std::to_string(value) +
                                ": expected a finite number");
  }
  inputs_.at(actuator) = value;
}

void World::set_field(std::size_t field, double reach) {
  fields_.at(field) = std::isfinite(reach) && reach > 0 ? reach : 0.0;
}

Display World::display() const {
  Display display;
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    if (lamps_[i] != 0) display.shining.push_back(catalogue_.lamps[i].geom);
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (fields_[i] != 0) display.fields.push_back({catalogue_.fields[i].site, fields_[i]});
  }
  return display;
}

bool World::advance(Time to, bool stops_at_contacts) {
  if (failed_) throw std::logic_error("the world has failed: restore a state or reset it first");
  if (to < now_) throw std::invalid_argument("a world cannot be advanced into its past");
  while (now_ < to) {
    if (resting_) rest(to);
    if (now_ == to) return false;
    if (now_ == grid_) take_inputs();
    const Time next = grid_ + timestep_;
    if (next <= to) {
      integrate();
      move(next, next);
      const bool has_contact_changed = look_for_contacts();
      if (rest_settings_) look_for_rest();
      if (has_contact_changed && stops_at_contacts) return true;
    } else {
      move(grid_, to);
    }
  }
  return false;
}

bool World::look_for_contacts() {
  if (contacts_.empty()) return false;
  const bool any = has_contact();
  bool has_changed = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double touching = any && is_touching(contacts_[i], *instant_data_) ? 1.0 : 0.0;
    has_changed = has_changed || touching != touching_[i];
    touching_[i] = touching;
  }
  return has_changed;
}

void World::take_inputs() {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Actuator& actuator = catalogue_.actuators[i];
    double& control = grid_data_->ctrl[actuator.control];
    control = taken_[i] = inputs_[i];
    if (const auto& ripple = actuator.ripple) {
      control += ripple->amplitude * std::sin(ripple->cycles * grid_data_->qpos[ripple->position]);
    }
  }
}

void World::integrate() {
  failed_ = true;
  grid_data_->time = stride::to_seconds(grid_);
  call_mujoco(mj_step, *model_, *grid_data_, grid_);
  check_motion();
  failed_ = false;
}

void World::check_motion() const {
  const mjData& data = *grid_data_;
  const mjWarningStat& bad_acceleration = data.warning[mjWARN_BADQACC];
  if (bad_acceleration.number > 0) {
    report_divergence("acceleration", model_->dof_jntid[bad_acceleration.lastinfo]);
  }
  const int bad_velocity = first_bad(data.qvel, static_cast<int>(model_->nv));
  if (bad_velocity >= 0) report_divergence("velocity", model_->dof_jntid[bad_velocity]);
  const int bad_position = first_bad(data.qpos, static_cast<int>(model_->nq));
  if (bad_position >= 0) report_divergence("position", joint_of_position(*model_, bad_position));
}

void World::report_divergence(const char* quantity, int joint) const {
  throw std::runtime_error(
      "the motion diverged in the step from " + std::to_string(stride::to_seconds(grid_)) +
      " s: the " + quantity + " of joint '" + name_of(*model_, mjOBJ_JOINT, joint) + "' of body '" +
      name_of(*model_, mjOBJ_BODY, model_->jnt_bodyid[joint]) +
      "' is out of bounds; try a smaller timestep, more damping or weaker actuators");
}

void World::move(Time grid, Time now) {
  grid_ = grid;
  now_ = now;
  pose_known_ = sensors_known_ = false;
}

const mjData& World::posed() const {
  mjData& data = *instant_data_;
  if (pose_known_) return data;
  api::get_state(model_.get(), grid_data_.get(), scratch_.data());
  api::set_state(model_.get(), &data, scratch_.data());
  data.time = stride::to_seconds(now_);
  if (now_ != grid_ && !resting_) {
    mj_integratePos(model_.get(), data.qpos, data.qvel, stride::to_seconds(now_ - grid_));
  }
  mj_kinematics(model_.get(), &data);
  mj_comPos(model_.get(), &data);
  mj_comVel(model_.get(), &data);
  pose_known_ = true;
  return data;
}

mjData& World::drawn() const {
  posed();
  mjData& data = *instant_data_;
  guarded([&] { api::place_what_follows(model_.get(), &data); });
  return data;
}

const mjData& World::collided() const {
  if (!has_contact()) instant_data_->ncon = 0;
  return *instant_data_;
}

const mjData& World::sensed() const {
  posed();
  if (sensors_known_) return *instant_data_;
  mjData& data = *instant_data_;
  if (only_touches_ && !has_contact()) {
    std::fill_n(data.sensordata, model_->nsensordata, 0.0);
  } else {
    call_mujoco(mj_forward, *model_, data, now_);
  }
  sensors_known_ = true;
  return data;
}

bool World::has_contact() const {
  posed();
  if (clearance_.excludes_contact(*model_, *instant_data_)) return false;
  call_mujoco(mj_collision, *model_, *instant_data_, now_);
  return instant_data_->ncon > 0;
}

double World::joint_position(std::size_t joint) const {
  return posed().qpos[catalogue_.joints.at(joint).position];
}

double World::joint_velocity(std::size_t joint) const {
  return posed().qvel[catalogue_.joints.at(joint).velocity];
}

Vector World::site_position(std::size_t site) const {
  const double* position = posed().site_xpos + 3 * catalogue_.sites.at(site).id;
  return {position[0], position[1], position[2]};
}

Vector World::site_axis(std::size_t site) const {
  const double* rows = posed().site_xmat + 9 * catalogue_.sites.at(site).id;
  return {rows[2], rows[5], rows[8]};
}

std::array<double, 6> World::spatial_velocity(std::size_t site) const {
  std::array<double, 6> velocity;
  mj_objectVelocity(model_.get(), &posed(), mjOBJ_SITE, catalogue_.sites.at(site).id,
                    velocity.data(), 0);
  return velocity;
}

Vector World::site_velocity(std::size_t site) const {
  const auto velocity = spatial_velocity(site);
  return {velocity[3], velocity[4], velocity[5]};
}

Vector World::site_axis_rate(std::size_t site) const {
  const auto velocity = spatial_velocity(site);
  const Vector axis = site_axis(site);
  Vector rate;
  mju_cross(rate.data(), velocity.data(), axis.data());
  return rate;
}

double World::sensor(std::size_t sensor, int element) const {
  const Sensor& entry = catalogue_.sensors.at(sensor);
  if (element < 0 || element >= entry.dimension) {
    throw std::out_of_range("sensor '" + entry.name + "' has " + std::to_string(entry.dimension) +
                            " elements");
  }
  return sensed().sensordata[entry.address + element];
}

std::size_t World::state_size() const {
  const std::size_t rest = rest_settings_ ? kRest + rest_detector_.state_size() : 0;
  return scratch_.size() + 2 * inputs_.size() + lamps_.size() + fields_.size() + touching_.size() +
         kTimes + rest;
}

void World::save(double* block) const {
  api::get_state(model_.get(), grid_data_.get(), block);
  block = std::copy(inputs_.begin(), inputs_.end(), block + scratch_.size());
  block = std::copy(taken_.begin(), taken_.end(), block);
  block = std::copy(lamps_.begin(), lamps_.end(), block);
  block = std::copy(fields_.begin(), fields_.end(), block);
  block = std::copy(touching_.begin(), touching_.end(), block);
  put_time(block, grid_);
  put_time(block + kTime, now_);
  block += kTimes;
  if (!rest_settings_) return;
  *block++ = resting_ ? 1 : 0;
  put_time(block, rest_end_);
  block += kTime;
  rest_detector_.save(block);
}

void World::restore(const double* block) {
  if (failed_) mj_resetData(model_.get(), grid_data_.get());
  failed_ = false;
  api::set_state(model_.get(), grid_data_.get(), block);
  block += scratch_.size();
  std::copy_n(block, inputs_.size(), inputs_.begin());
  block += inputs_.size();
  std::copy_n(block, taken_.size(), taken_.begin());
  block += taken_.size();
  std::copy_n(block, lamps_.size(), lamps_.begin());
  block += lamps_.size();
  std::copy_n(block, fields_.size(), fields_.begin());
  block += fields_.size();
  std::copy_n(block, touching_.size(), touching_.begin());
  block += touching_.size();
  const double* times = block;
  block += kTimes;
  if (rest_settings_) {
    resting_ = *block++ != 0;
    rest_end_ = get_time(block);
    block += kTime;
    rest_detector_.restore(block);
  }
  move(get_time(times), get_time(times + kTime));
}

}  // namespace mujoco_world
