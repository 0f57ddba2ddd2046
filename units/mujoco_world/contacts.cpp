#include "units/mujoco_world/contacts.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "units/mujoco_world/clearance.h"
#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/mujoco_api.h"

namespace mujoco_world {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& name,
                         const std::string& reason) {
  throw std::runtime_error("'" + file.string() + "': <tuple name=\"" + kContact + name +
                           "\">: " + reason);
}

/// One element of a tuple as the geoms that it stands for; empty if it is neither body nor geom.
std::vector<bool> geoms_of(const mjModel& model, int element) {
  const int type = model.tuple_objtype[element];
  const int id = model.tuple_objid[element];
  if (type != mjOBJ_BODY && type != mjOBJ_GEOM) return {};
  std::vector<bool> geoms(static_cast<std::size_t>(model.ngeom));
  for (int i = 0; i < model.ngeom; ++i) {
    geoms[static_cast<std::size_t>(i)] = (type == mjOBJ_GEOM ? i : model.geom_bodyid[i]) == id;
  }
  return geoms;
}

bool joins(const WatchedContact& contact, int one, int other) {
  const auto a = static_cast<std::size_t>(one);
  const auto b = static_cast<std::size_t>(other);
  return (contact.first[a] && contact.second[b]) || (contact.first[b] && contact.second[a]);
}

bool can_touch(const mjModel& model, const WatchedContact& contact) {
  for (int i = 0; i < model.npair; ++i) {
    if (joins(contact, model.pair_geom1[i], model.pair_geom2[i])) return true;
  }
  for (int i = 0; i < model.ngeom; ++i) {
    for (int k = i + 1; k < model.ngeom; ++k) {
      if (joins(contact, i, k) && may_collide(model, i, k)) return true;
    }
  }
  return false;
}

WatchedContact read_tuple(const mjModel& model, int tuple, const std::string& name,
                          const std::filesystem::path& file) {
  const int size = model.tuple_size[tuple];
  const int first = model.tuple_adr[tuple];
  if (size > 2) refuse(file, name, "expected one or two elements");
  WatchedContact contact{name, geoms_of(model, first), geoms_of(model, first + size - 1)};
  if (contact.first.empty() || contact.second.empty()) {
    refuse(file, name, "expected elements with objtype=\"body\" or objtype=\"geom\"");
  }
  if (size == 1) std::fill(contact.second.begin(), contact.second.end(), true);
  if (!can_touch(model, contact)) {
    refuse(file, name,
           "MuJoCo does not let them collide: see contype and conaffinity of their geoms, and "
           "whether they are fixed to each other");
  }
  return contact;
}

}  // namespace

std::vector<WatchedContact> list_contacts(const mjModel& model, const std::filesystem::path& file) {
  const std::string prefix = kContact;
  std::vector<WatchedContact> list;
  for (int i = 0; i < model.ntuple; ++i) {
    const std::string name = name_of(model, mjOBJ_TUPLE, i);
    if (name.rfind(prefix, 0) != 0) continue;
    list.push_back(read_tuple(model, i, name.substr(prefix.size()), file));
  }
  return list;
}

bool is_touching(const WatchedContact& contact, const mjData& data) {
  return std::any_of(data.contact, data.contact + data.ncon, [&](const mjContact& found) {
    const auto [one, other] = api::touching_geoms(found);
    return one >= 0 && other >= 0 && found.dist < found.includemargin && joins(contact, one, other);
  });
}

}  // namespace mujoco_world
