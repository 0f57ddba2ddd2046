// The character encoding of the XML files that robots come in.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_ENCODING_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_ENCODING_H

#include <string>

namespace mujoco_world {

/// A document as UTF-8, whose lines stay where they are; its declaration is left as it is. The
/// encoding is UTF-16 if the first characters say so, with or without a byte order mark, or else
/// the one that the XML declaration names (XML 1.0, appendix F), which may be any that iconv knows.
///
/// Throws std::runtime_error with file and line for an encoding that is not known, and for bytes
/// that are none of it. UTF-8 is not examined.
std::string decode_xml(const std::string& bytes, const std::string& file);

}  // namespace mujoco_world

#endif
