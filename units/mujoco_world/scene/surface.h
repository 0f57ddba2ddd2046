// The surfaces of geoms, as triangles.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_SURFACE_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_SURFACE_H

#include <cstdint>
#include <vector>

#include <mujoco/mujoco.h>

namespace mujoco_world::scene {

/// In the geom's frame; triangles are counter-clockwise where they are seen from outside.
struct Surface {
  std::vector<float> positions;        ///< x, y, z of each vertex [m]
  std::vector<float> normals;          ///< likewise, of unit length
  std::vector<float> texture_places;   ///< u, v of each vertex; empty: the geom has none
  std::vector<std::uint32_t> corners;  ///< of the triangles, indices of vertices
};

/// Round ones have as many facets as in a film (<visual><quality numslices numstacks>). A plane
/// that is infinite is as large as the camera sees far. Empty for a type that has no surface.
///
/// With `is_textured`, a texture of two dimensions is put on it as MuJoCo does: by the texture
/// coordinates of a mesh, else along x and y, as often as the geom's material says.
Surface surface_of(const mjModel& model, int geom, bool is_textured);

/// A sphere, to be put around what shines.
Surface ball(const mjModel& model, double radius);

/// An ellipsoid of revolution about z, for fields.
Surface spheroid(const mjModel& model, double across, double along);

}  // namespace mujoco_world::scene

#endif
