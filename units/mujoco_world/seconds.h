// Times as text, exactly.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SECONDS_H
#define STRIDE_UNITS_MUJOCO_WORLD_SECONDS_H

#include <optional>
#include <string>

#include <stride/time.h>

namespace mujoco_world {

/// Exactly, such as "-0.000001", "12" and "0.1".
std::string seconds_text(stride::Time time);
/// The time of such a text; nothing for any other.
std::optional<stride::Time> time_of(const std::string& seconds);

}  // namespace mujoco_world

#endif
