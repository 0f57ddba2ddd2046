// An XML document written such that its elements stay in their lines.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_LINE_KEEPING_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_LINE_KEEPING_H

#include <filesystem>

#include <tinyxml2.h>

namespace mujoco_world {

/// Writes a document that was changed after it was read, so that what another program reports about
/// an element has the line of the file that the user has. Elements that were added are in the line
/// of the one before. Throws std::runtime_error with the file.
void write_keeping_lines(const tinyxml2::XMLDocument& document, const std::filesystem::path& file);

}  // namespace mujoco_world

#endif
