#include "units/mujoco_world/clearance.h"

#include <algorithm>
#include <cmath>

#include "units/mujoco_world/mujoco_api.h"

namespace mujoco_world {
namespace {

// Smaller is exacter as the first of a pair.
int rank(const mjModel& model, int geom) {
  if (model.geom_type[geom] == mjGEOM_PLANE) return 0;
  return model.geom_type[geom] == mjGEOM_BOX ? 1 : 2;
}

// From a geom's surface, or from its centre if it is neither a plane nor a box.
double distance(const mjModel& model, const mjData& data, int geom, const double* point) {
  const double* const centre = data.geom_xpos + 3 * geom;
  const double* const rotation = data.geom_xmat + 9 * geom;
  const double apart[3] = {point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]};
  if (model.geom_type[geom] == mjGEOM_PLANE) {
    return rotation[2] * apart[0] + rotation[5] * apart[1] + rotation[8] * apart[2];
  }
  if (model.geom_type[geom] != mjGEOM_BOX) return std::hypot(apart[0], apart[1], apart[2]);
  double outside[3];
  for (int i = 0; i < 3; ++i) {
    const double local =
        rotation[i] * apart[0] + rotation[3 + i] * apart[1] + rotation[6 + i] * apart[2];
    outside[i] = std::max(0.0, std::abs(local) - model.geom_size[3 * geom + i]);
  }
  return std::hypot(outside[0], outside[1], outside[2]);
}

}  // namespace

bool may_collide(const mjModel& model, int first, int second) {
  const int* const weld = model.body_weldid;
  if (weld[model.geom_bodyid[first]] == weld[model.geom_bodyid[second]]) return false;
  return (model.geom_contype[first] & model.geom_conaffinity[second]) != 0 ||
         (model.geom_contype[second] & model.geom_conaffinity[first]) != 0;
}

Clearance::Clearance(const mjModel& model)
    : is_bounded_(model.npair == 0 && !api::has_deformables(&model)) {
  for (int i = 0; i < model.ngeom; ++i) {
    for (int k = i + 1; k < model.ngeom; ++k) {
      if (!may_collide(model, i, k)) continue;
      const bool swapped = rank(model, k) < rank(model, i);
      const int first = swapped ? k : i;
      const int second = swapped ? i : k;
      if (rank(model, second) == 0) continue;  // planes do not meet
      is_bounded_ &= model.geom_type[first] != mjGEOM_HFIELD;
      is_bounded_ &= model.geom_type[second] != mjGEOM_HFIELD;
      double reach = model.geom_rbound[second] + model.geom_margin[i] + model.geom_margin[k];
      if (rank(model, first) == 2) reach += model.geom_rbound[first];
      pairs_.push_back({first, second, reach});
    }
  }
}

bool Clearance::excludes_contact(const mjModel& model, const mjData& data) const {
  return is_bounded_ && std::all_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
           return distance(model, data, pair.first, data.geom_xpos + 3 * pair.second) > pair.reach;
         });
}

}  // namespace mujoco_world
