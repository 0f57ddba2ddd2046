#include "units/mujoco_world/start_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/mujoco_api.h"
#include "units/mujoco_world/names.h"

namespace mujoco_world {
namespace {

constexpr double kNotSet = std::numeric_limits<double>::quiet_NaN();

// what rests on something sinks in by less, as contacts of the default stiffness are [m]
constexpr double kSunkIn = 1e-3;

constexpr const char* kPlaceAxes[] = {"x", "y", "z"};
constexpr const char* kTurnAxes[] = {"w", "x", "y", "z"};

std::string keyframes(const mjModel& model) {
  std::string names;
  for (int i = 0; i < model.nkey; ++i) {
    const char* name = mj_id2name(&model, mjOBJ_KEY, i);
    if (name && *name) names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  return names.empty() ? "none with a name" : names;
}

void list_orientation(std::vector<StartPosition>& list, const std::string& name,
                      const std::string& what) {
  for (const char* axis : kTurnAxes) {
    list.push_back({name + "." + axis, "", what + ", a quaternion's " + axis});
  }
}

void list_joint(std::vector<StartPosition>& list, const mjModel& model, int joint) {
  const std::string name = name_of(model, mjOBJ_JOINT, joint);
  const std::string start = "joint." + name_part(name) + ".start";
  const int type = model.jnt_type[joint];
  if (type == mjJNT_HINGE || type == mjJNT_SLIDE) {
    list.push_back({start, type == mjJNT_HINGE ? "rad" : "m", "position of the joint " + name});
  } else {
    list_orientation(list, start, "orientation of the joint " + name);
  }
}

void list_free_body(std::vector<StartPosition>& list, const mjModel& model, int body) {
  const std::string name = name_of(model, mjOBJ_BODY, body);
  const std::string start = "body." + name_part(name) + ".start";
  for (const char* axis : kPlaceAxes) {
    list.push_back({start + ".position." + axis, "m", "position of the body " + name});
  }
  list_orientation(list, start + ".orientation", "orientation of the body " + name);
}

/// Of a ball or free joint, where its quaternion begins in qpos; -1 of others.
int quaternion_of(const mjModel& model, int joint) {
  if (model.jnt_type[joint] == mjJNT_BALL) return model.jnt_qposadr[joint];
  return model.jnt_type[joint] == mjJNT_FREE ? model.jnt_qposadr[joint] + 3 : -1;
}

void check_orientations(const mjModel& model, const std::vector<double>& positions) {
  for (int i = 0; i < model.njnt; ++i) {
    const int first = quaternion_of(model, i);
    if (first < 0) continue;
    const double* const parts = positions.data() + first;
    const auto set = std::count_if(parts, parts + 4, [](double x) { return !std::isnan(x); });
    if (set == 0) continue;
    const bool is_zero = std::all_of(parts, parts + 4, [](double x) { return x == 0; });
    if (set == 4 && !is_zero) continue;
    const std::string w = list_start_positions(model).at(static_cast<std::size_t>(first)).parameter;
    throw std::invalid_argument("the start orientation " + w.substr(0, w.size() - 1) +
                                "{w,x,y,z} " + (set == 4 ? "is zero" : "is set in part") +
                                ": expected all four numbers of a quaternion, 1 0 0 0 for upright");
  }
}

void check_positions(const mjModel& model, const std::vector<double>& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isinf(positions[i])) continue;
    throw std::invalid_argument(list_start_positions(model).at(i).parameter +
                                " is infinite: expected a number, or NaN for the keyframe's");
  }
  check_orientations(model, positions);
}

void put_at_keyframe(const mjModel& model, mjData& data, const std::string& name) {
  if (name.empty()) return mj_resetData(&model, &data);
  const int key = mj_name2id(&model, mjOBJ_KEY, name.c_str());
  if (key < 0) {
    throw std::invalid_argument("the model has no keyframe '" + name +
                                "' to start with; its keyframes are: " + keyframes(model) +
                                "; an empty name is its reference pose");
  }
  mj_resetDataKeyframe(&model, &data, key);
}

std::string in_short(double number) { return (std::ostringstream() << number).str(); }

/// A body, and its geom where that has a name.
std::string body_and_geom(const mjModel& model, int geom) {
  const char* name = mj_id2name(&model, mjOBJ_GEOM, geom);
  const std::string body = "'" + name_of(model, mjOBJ_BODY, model.geom_bodyid[geom]) + "'";
  return name && *name ? body + " (geom '" + name + "')" : body;
}

std::vector<std::string> penetrations(const mjModel& model, const mjData& data) {
  std::map<std::pair<int, int>, const mjContact*> deepest;  // of two bodies
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const auto [one, other] = api::touching_geoms(contact);
    if (one < 0 || other < 0 || contact.dist > -kSunkIn) continue;
    const mjContact*& found = deepest[{model.geom_bodyid[one], model.geom_bodyid[other]}];
    if (found == nullptr || contact.dist < found->dist) found = &contact;
  }
  std::vector<std::string> list;
  for (const auto& [bodies, contact] : deepest) {
    const auto [one, other] = api::touching_geoms(*contact);
    list.push_back("the initial pose has " + body_and_geom(model, one) + " " +
                   in_short(-1e3 * contact->dist) + " mm inside of " + body_and_geom(model, other) +
                   ": they will be thrown apart; start elsewhere");
  }
  return list;
}

std::vector<std::string> joints_out_of_range(const mjModel& model, const mjData& data) {
  std::vector<std::string> list;
  for (int i = 0; i < model.njnt; ++i) {
    const bool is_scalar = model.jnt_type[i] == mjJNT_HINGE || model.jnt_type[i] == mjJNT_SLIDE;
    if (!is_scalar || !model.jnt_limited[i]) continue;
    const double position = data.qpos[model.jnt_qposadr[i]];
    const double* const range = model.jnt_range + 2 * i;
    if (position >= range[0] && position <= range[1]) continue;
    list.push_back("the initial pose has the joint '" + name_of(model, mjOBJ_JOINT, i) + "' at " +
                   in_short(position) + ", outside of its range from " + in_short(range[0]) +
                   " to " + in_short(range[1]));
  }
  return list;
}

}  // namespace

StartPose default_start(const mjModel& model) {
  const bool has_start = mj_name2id(&model, mjOBJ_KEY, kStartKeyframe) >= 0;
  return {has_start ? kStartKeyframe : "",
          std::vector<double>(static_cast<std::size_t>(model.nq), kNotSet)};
}

std::vector<StartPosition> list_start_positions(const mjModel& model) {
  std::vector<StartPosition> list;
  for (int i = 0; i < model.njnt; ++i) {
    if (model.jnt_type[i] == mjJNT_FREE) {
      list_free_body(list, model, model.jnt_bodyid[i]);
    } else {
      list_joint(list, model, i);
    }
  }
  return list;
}

void put_at_start(const mjModel& model, mjData& data, const StartPose& pose) {
  check_positions(model, pose.positions);
  put_at_keyframe(model, data, pose.keyframe);
  for (std::size_t i = 0; i < pose.positions.size(); ++i) {
    if (!std::isnan(pose.positions[i])) data.qpos[i] = pose.positions[i];
  }
  if (!pose.positions.empty()) mj_normalizeQuat(&model, data.qpos);
}

std::vector<std::string> flaws_of_pose(const mjModel& model, const mjData& data) {
  std::vector<std::string> flaws = penetrations(model, data);
  for (std::string& flaw : joints_out_of_range(model, data)) flaws.push_back(std::move(flaw));
  return flaws;
}

}  // namespace mujoco_world
