// Numbers in the buffer of a glTF document.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_BUFFER_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_BUFFER_H

#include <cstdint>
#include <vector>

#include <tiny_gltf.h>

namespace mujoco_world::scene {

/// Adds the bytes to the document's buffer, with a view of them, whose index is returned. `target`
/// is what they are for, or 0.
int add_view(tinygltf::Model& document, const void* bytes, std::size_t size, int target);

/// Adds numbers, with their limits, as elements of a type such as TINYGLTF_TYPE_VEC3; returns the
/// index of the accessor.
int add_floats(tinygltf::Model& document, const std::vector<float>& numbers, int type,
               int target = 0);
int add_indices(tinygltf::Model& document, const std::vector<std::uint32_t>& indices);

}  // namespace mujoco_world::scene

#endif
