// Whether anything in a world can touch at all, by bounding volumes.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_CLEARANCE_H
#define STRIDE_UNITS_MUJOCO_WORLD_CLEARANCE_H

#include <vector>

#include <mujoco/mujoco.h>

namespace mujoco_world {

/// Whether MuJoCo looks for contacts of two geoms, by its documentation, "Collision detection", but
/// for explicit pairs; those that it leaves out because one body is the other's parent are kept.
bool may_collide(const mjModel& model, int first, int second);

/// Knows a lower bound of the distance of each two geoms that MuJoCo would look at: between a plane
/// or box and the other's bounding sphere, else between both bounding spheres. Much cheaper than
/// mj_collision() where a wide table lies below everything, which bounding spheres do not tell
/// apart.
class Clearance {
 public:
  explicit Clearance(const mjModel& model);

  /// True only if mj_collision() would find no contact at the poses in `data`, which
  /// mj_kinematics() has computed for the same model. False means nothing.
  bool excludes_contact(const mjModel& model, const mjData& data) const;

 private:
  struct Pair {
    int first;     ///< the plane or the box, if one of them is
    int second;    ///< as its bounding sphere
    double reach;  ///< the bounding spheres' radii and the margins [m]
  };

  std::vector<Pair> pairs_;
  bool is_bounded_;  ///< there is nothing but geoms that have bounds
};

}  // namespace mujoco_world

#endif
