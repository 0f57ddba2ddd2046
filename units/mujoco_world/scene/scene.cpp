#include "units/mujoco_world/scene/scene.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <stride/time_text.h>

#include "units/mujoco_world/write_error.h"

namespace mujoco_world::scene {
namespace {

namespace fs = std::filesystem;
using stride::Duration;
using stride::Time;
using Clock = std::chrono::steady_clock;

constexpr Clock::duration kShortestBetweenWrites = std::chrono::seconds(2);
constexpr int kShareOfWrites = 20;  // one part of so many of the time

const Value kUnknown{std::numeric_limits<float>::quiet_NaN(), 0, 0, 0};

Duration checked(Duration interval) {
  if (interval > Duration{}) return interval;
  throw std::invalid_argument("the interval of a scene is not above 0");
}

/// To three digits: a field that hardly changes needs no keyframe at each pose.
double rounded(double reach) {
  const double digit = std::pow(10, std::floor(std::log10(reach)) - 2);
  return std::round(reach / digit) * digit;
}

float reach_of(const Display& display, int site) {
  for (const ShownField& field : display.fields) {
    if (field.site == site) return static_cast<float>(rounded(field.reach));
  }
  return 0;
}

/// But for how far fields reach.
bool has_same_parts(const Display& one, const Display& other) {
  return one.shining == other.shining &&
         std::equal(one.fields.begin(), one.fields.end(), other.fields.begin(), other.fields.end(),
                    [](const ShownField& a, const ShownField& b) { return a.site == b.site; });
}

fs::path beside(const fs::path& file) { return file.string() + ".part"; }

/// So that there is a whole file under its name at any time.
void replace_file(const fs::path& file, const std::string& bytes) {
  const fs::path part = beside(file);
  errno = 0;
  std::ofstream stream(part, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) fail_to_write(part);
  std::error_code error;
  fs::rename(part, file, error);
  if (error) throw std::system_error(error, "cannot write '" + file.string() + "'");
}

/// Before the run, not after it.
void check_that_it_can_be_written(const fs::path& file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    throw std::system_error(error, "cannot make the folder '" + file.parent_path().string() + "'");
  }
  errno = 0;
  if (!std::ofstream(beside(file))) fail_to_write(beside(file));
  fs::remove(beside(file), error);
}

Value point(const double* position) {
  return {static_cast<float>(position[0]), static_cast<float>(position[1]),
          static_cast<float>(position[2]), 0};
}

Value rotation(const double* quaternion) {
  return {static_cast<float>(quaternion[1]), static_cast<float>(quaternion[2]),
          static_cast<float>(quaternion[3]), static_cast<float>(quaternion[0])};
}

}  // namespace

void SceneState::write(stride::StateWriter& writer) const {
  writer.write(has_begun);
  if (!has_begun) return;
  writer.write(start);
  animation.write(writer);
}

void SceneState::read(stride::StateReader& reader) {
  reader.read(has_begun);
  if (!has_begun) return;
  reader.read(start);
  animation.read(reader);
}

Scene::Scene(World& world, Duration interval, const fs::path& file, AnimationLimits limits)
    : world_(world),
      interval_(checked(interval)),
      file_(file),
      document_(world.model(), animated_of(world.model(), world.catalogue())),
      animation_(
          document_.animated().tracks(),
          [&] {
            limits.interval = stride::to_seconds(interval);
            return limits;
          }(),
          fs::path(file).replace_extension(".keys")) {
  check_that_it_can_be_written(file_);
}

Scene::~Scene() {
  if (!has_begun_ || is_written_) return;
  try {
    // a world that has failed has no present
    world_.has_failed() ? write_to_file(sampled_, unknown_values()) : write();
  } catch (const std::exception&) {
  }
}

void Scene::begin() {
  if (has_begun_) return;
  has_begun_ = true;
  start_ = world_.now();
  animation_.clear();
  next_ = first_multiple_at_or_after(world_.now(), interval_);
  next_ == world_.now() ? take() : sample();
  write();
}

void Scene::show_display() {
  if (!has_same_parts(shown_, world_.display())) sample();
}

void Scene::take() {
  next_ = stride::later(next_, interval_);
  sample();
  const auto since = Clock::now() - last_write_;
  if (since > kShortestBetweenWrites && since > kShareOfWrites * write_duration_) write();
}

void Scene::sample() {
  is_written_ = false;
  sampled_ = world_.now();
  shown_ = world_.display();
  animation_.observe(seconds(world_.now()), values());
}

void Scene::write() { write_to_file(world_.now(), values()); }

void Scene::write_to_file(Time end, const std::vector<Value>& values) {
  const auto begin = Clock::now();
  RunNotes notes;
  notes.start_time = stride::decimal_seconds(start_);
  notes.stop_time = stride::decimal_seconds(end);
  notes.interval = stride::to_seconds(interval_);
  notes.tolerance = animation_.tolerance();
  notes.resolution = animation_.resolution();
  notes.samples = animation_.samples() + (end == sampled_ ? 0 : 1);
  notes.duration = time_of_keyframe(seconds(end));
  replace_file(file_, document_.bytes(animation_.tracks(seconds(end), values), notes));
  is_written_ = true;
  written_end_ = end;
  last_write_ = Clock::now();
  write_duration_ = last_write_ - begin;
}

std::vector<Value> Scene::values() {
  values_.clear();
  put_poses(world_.drawn());
  for (const Lamp& lamp : world_.catalogue().lamps) {
    const auto& shining = shown_.shining;
    const bool is_on = std::find(shining.begin(), shining.end(), lamp.geom) != shining.end();
    values_.push_back({is_on ? 1.0F : 0.0F, 0, 0, 0});
  }
  for (const Field& field : world_.catalogue().fields) {
    values_.push_back({reach_of(shown_, field.site), 0, 0, 0});
  }
  put_contacts(world_.collided());
  return values_;
}

void Scene::put_poses(const mjData& data) {
  const mjModel& model = world_.model();
  const Animated& animated = document_.animated();
  for (const int body : animated.bodies) {
    const int parent = model.body_parentid[body];
    double position[3];
    double to_parent[4];
    double quaternion[4];
    mju_negQuat(to_parent, data.xquat + 4 * parent);
    mju_sub3(position, data.xpos + 3 * body, data.xpos + 3 * parent);
    mju_rotVecQuat(position, position, to_parent);
    mju_mulQuat(quaternion, to_parent, data.xquat + 4 * body);
    values_.push_back(point(position));
    values_.push_back(rotation(quaternion));
  }
  for (const int camera : animated.cameras) {
    double quaternion[4];
    mju_mat2Quat(quaternion, data.cam_xmat + 9 * camera);
    values_.push_back(point(data.cam_xpos + 3 * camera));
    values_.push_back(rotation(quaternion));
  }
  for (const int light : animated.lights) {
    double quaternion[4];
    light_orientation(data.light_xdir + 3 * light, quaternion);
    values_.push_back(point(data.light_xpos + 3 * light));
    values_.push_back(rotation(quaternion));
  }
}

/// Those that may exert a force, in MuJoCo's order.
void Scene::put_contacts(const mjData& data) {
  std::size_t shown = 0;
  for (int i = 0; i < data.ncon && shown < document_.animated().contacts; ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.dist >= contact.includemargin) continue;
    const double* normal = contact.frame;  // and two tangents
    const double matrix[9] = {normal[3], normal[6], normal[0], normal[4], normal[7],
                              normal[1], normal[5], normal[8], normal[2]};
    double quaternion[4];
    mju_mat2Quat(quaternion, matrix);
    values_.push_back(point(contact.pos));
    values_.push_back(rotation(quaternion));
    values_.push_back({1, 0, 0, 0});
    ++shown;
  }
  for (; shown < document_.animated().contacts; ++shown) {
    values_.insert(values_.end(), {kUnknown, kUnknown, Value{}});
  }
}

std::vector<Value> Scene::unknown_values() const {
  return std::vector<Value>(document_.animated().tracks().size(), kUnknown);
}

SceneState Scene::state() {
  if (!has_begun_) return {};
  return {true, start_, animation_.state()};
}

bool Scene::go_on(const SceneState& state) {
  const bool was_here = std::exchange(has_begun_, state.has_begun);
  if (!has_begun_) return true;
  shown_ = world_.display();
  sampled_ = world_.now();
  next_ = first_multiple_at_or_after(world_.now(), interval_);
  is_written_ = false;
  start_ = state.start;
  const bool is_known = animation_.restore(state.animation);
  if (next_ == world_.now()) next_ = stride::later(next_, interval_);
  if (!is_known) sample();
  if (!was_here || !is_known || written_end_ > world_.now()) write();
  return is_known;
}

}  // namespace mujoco_world::scene
