// A URDF made ready for MuJoCo, which reads URDF, but not each as it comes.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_URDF_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_URDF_H

#include <filesystem>

#include <tinyxml2.h>

namespace mujoco_world {

bool is_urdf(const tinyxml2::XMLElement& root);

/// Names each mesh of the collision geometry by its absolute path, takes the others out, and asks
/// MuJoCo to keep each link as a body; repair_inertias() applies. `file` is where the URDF was read
/// from. Throws std::runtime_error with file and line for a mesh that is missing, with where it was
/// looked for, for two meshes of one name, which MuJoCo would take for one, and for a joint of a
/// type that MuJoCo does not know.
void prepare_urdf(tinyxml2::XMLElement& root, const std::filesystem::path& file);

}  // namespace mujoco_world

#endif
