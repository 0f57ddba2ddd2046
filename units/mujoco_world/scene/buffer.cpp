#include "units/mujoco_world/scene/buffer.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace mujoco_world::scene {
namespace {

/// Lowest and highest of each component.
void set_limits(tinygltf::Accessor& accessor, const std::vector<float>& numbers,
                std::size_t components) {
  accessor.minValues.assign(components, std::numeric_limits<double>::infinity());
  accessor.maxValues.assign(components, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    double& low = accessor.minValues[i % components];
    double& high = accessor.maxValues[i % components];
    low = std::min(low, double{numbers[i]});
    high = std::max(high, double{numbers[i]});
  }
}

int add(tinygltf::Model& document, tinygltf::Accessor accessor) {
  document.accessors.push_back(std::move(accessor));
  return static_cast<int>(document.accessors.size()) - 1;
}

}  // namespace

int add_view(tinygltf::Model& document, const void* bytes, std::size_t size, int target) {
  auto& data = document.buffers.front().data;
  data.resize((data.size() + 3) / 4 * 4);  // numbers of four bytes stand at multiples of that
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = size;
  view.target = target;
  const auto* const first = static_cast<const unsigned char*>(bytes);
  data.insert(data.end(), first, first + size);
  document.bufferViews.push_back(std::move(view));
  return static_cast<int>(document.bufferViews.size()) - 1;
}

int add_floats(tinygltf::Model& document, const std::vector<float>& numbers, int type, int target) {
  const auto components =
      static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(document, numbers.data(), numbers.size() * sizeof(float), target);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = type;
  accessor.count = numbers.size() / components;
  set_limits(accessor, numbers, components);
  return add(document, std::move(accessor));
}

int add_indices(tinygltf::Model& document, const std::vector<std::uint32_t>& indices) {
  tinygltf::Accessor accessor;
  const std::uint32_t highest = *std::max_element(indices.begin(), indices.end());
  if (highest < std::numeric_limits<std::uint16_t>::max()) {
    std::vector<std::uint16_t> narrow(indices.size());
    std::transform(indices.begin(), indices.end(), narrow.begin(),
                   [](std::uint32_t index) { return static_cast<std::uint16_t>(index); });
    accessor.bufferView = add_view(document, narrow.data(), narrow.size() * sizeof narrow[0],
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  } else {
    accessor.bufferView = add_view(document, indices.data(), indices.size() * sizeof indices[0],
                                   TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  }
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = indices.size();
  return add(document, std::move(accessor));
}

}  // namespace mujoco_world::scene
