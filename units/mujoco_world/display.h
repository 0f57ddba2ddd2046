// What devices show, which is seen in pictures and scenes and moves nothing.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_DISPLAY_H
#define STRIDE_UNITS_MUJOCO_WORLD_DISPLAY_H

#include <vector>

namespace mujoco_world {

/// A field that is there, of a coil whose axis is the z axis of a site.
struct ShownField {
  int site;      ///< its id
  double reach;  ///< along the axis [m]

  friend bool operator==(const ShownField& a, const ShownField& b) {
    return a.site == b.site && a.reach == b.reach;
  }
};

struct Display {
  std::vector<int> shining;        ///< the geoms that are lamps which are on, as their ids
  std::vector<ShownField> fields;  ///< in the order of their list

  friend bool operator==(const Display& a, const Display& b) {
    return a.shining == b.shining && a.fields == b.fields;
  }
  friend bool operator!=(const Display& a, const Display& b) { return !(a == b); }
};

/// Where a magnetic dipole's field is as strong as on its axis in the distance R, it is
/// R ((1 + 3 cos^2 t) / 4)^(1/6) away, t being the angle to the axis (|H| = m sqrt(1 + 3 cos^2 t) /
/// (4 pi r^3): Jackson, "Classical Electrodynamics", 3rd ed., sect. 5.6). An ellipsoid of
/// revolution with the same axes is drawn, which is inside of that by 5.1 % at most.
inline constexpr double kFieldWidth = 0.793700525984099737;  ///< across the axis: (1/4)^(1/6)
inline constexpr float kFieldOpacity = 0.2F;

}  // namespace mujoco_world

#endif
