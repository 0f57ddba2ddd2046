// Which contacts of a world are seen outside of it.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_CONTACTS_H
#define STRIDE_UNITS_MUJOCO_WORLD_CONTACTS_H

#include <filesystem>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

namespace mujoco_world {

/// The contact NAME is a <custom><tuple name="contact.NAME"> of two elements, each a body or a geom
/// (objtype="body" or "geom"); one alone: with anything. A body stands for its own geoms, not for
/// those of its children.
inline constexpr const char* kContact = "contact.";

struct WatchedContact {
  std::string name;
  std::vector<bool> first;   ///< whether each geom belongs to the first element
  std::vector<bool> second;  ///< to the second; all, if there is none
};

/// Throws std::runtime_error, with `file`, for a tuple that has not one or two bodies or geoms, and
/// for two that MuJoCo does not let collide.
std::vector<WatchedContact> list_contacts(const mjModel& model, const std::filesystem::path& file);

/// Whether they touch: one of MuJoCo's contacts of this instant, of mj_collision(), is nearer than
/// its margin less its gap, so that it may exert a force.
bool is_touching(const WatchedContact& contact, const mjData& data);

}  // namespace mujoco_world

#endif
