// States of worlds, to be compared.
#ifndef STRIDE_TESTS_UNITS_MUJOCO_WORLD_STATES_H
#define STRIDE_TESTS_UNITS_MUJOCO_WORLD_STATES_H

#include <cstring>
#include <vector>

#include "units/mujoco_world/model.h"

namespace worlds {

inline std::vector<double> saved(const mujoco_world::World& world) {
  std::vector<double> block(world.state_size());
  world.save(block.data());
  return block;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace worlds

#endif
