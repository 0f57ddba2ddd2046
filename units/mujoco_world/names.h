// Names of a model in the names of variables.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_NAMES_H
#define STRIDE_UNITS_MUJOCO_WORLD_NAMES_H

#include <string>

namespace mujoco_world {

/// A name as one part of a structured variable name: as it is if it is an identifier, else in
/// single quotes (FMI 3.0, 2.4.7.5.1). These have printable ASCII characters only, and no
/// backtick: throws std::runtime_error, with the name, for others.
std::string name_part(const std::string& name);

}  // namespace mujoco_world

#endif
