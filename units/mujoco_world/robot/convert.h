// A robot's model of any origin, as an MJCF that a scene can include.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_CONVERT_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_CONVERT_H

#include <filesystem>
#include <string>
#include <vector>

#include "units/mujoco_world/mjcf.h"

namespace mujoco_world {

/// What a body of the robot gets beside what it has.
struct Mount {
  std::string body;
  std::filesystem::path file;  ///< an MJCF; what its root holds goes into the body
};

/// Compiles an MJCF, or a URDF as convert() reads it, and throws likewise.
ModelPointer load_robot(const std::filesystem::path& model);

struct Conversion {
  std::filesystem::path model;  ///< an MJCF or a URDF that MuJoCo reads
  std::vector<Mount> mounts;
  std::filesystem::path output;  ///< NAME.xml
};

/// Writes the model as one MJCF, and the meshes, textures and height fields that it names into the
/// folder NAME beside that. Numbers have six digits, as MuJoCo saves them. Returns remarks for the
/// user, each a line: what was left out.
///
/// Each link of a URDF becomes a body, also one without mass. What a link looks like is left out,
/// its collision geometry stays, as MuJoCo does with a URDF. A mesh is looked for as its filename
/// has it, relative to the file; package://NAME/… in the folder NAME, in or above that of the file;
/// and in the URDF's own <mujoco><compiler meshdir>. Masses and inertias that MuJoCo refuses are
/// repaired, with warnings (inertia.h). A URDF may have any encoding that iconv knows, an MJCF is
/// UTF-8.
///
/// Left out are keyframes, since they do not fit a scene with further joints, and the sizes of
/// MuJoCo's buffers.
///
/// Throws std::runtime_error with the file (and line, if it is one of its own lines): for what is
/// neither, a mesh that is missing, two meshes of one name, a joint of an unknown type, an encoding
/// that cannot be read, a body that is not there, and as load_model() does.
std::vector<std::string> convert(const Conversion& conversion);

}  // namespace mujoco_world

#endif
