// A glTF file as a viewer sees it at a time, in MuJoCo's frame.
#ifndef STRIDE_TESTS_UNITS_MUJOCO_WORLD_SCENE_GLB_H
#define STRIDE_TESTS_UNITS_MUJOCO_WORLD_SCENE_GLB_H

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <tiny_gltf.h>

namespace stride::tests {

class Glb {
 public:
  explicit Glb(const std::filesystem::path& file) {
    std::string error;
    std::string warning;
    tinygltf::TinyGLTF reader;
    const bool is_read = reader.LoadBinaryFromFile(&model, &error, &warning, file.string());
    INFO(error << warning);
    REQUIRE(is_read);
    REQUIRE(warning.empty());
    REQUIRE(model.scenes.size() == 1);
    REQUIRE(model.scenes[0].nodes.size() == 1);
    REQUIRE(model.animations.size() == 1);
    REQUIRE(model.animations[0].name == "run");
    parents_.assign(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      for (const int child : model.nodes[i].children) {
        parents_[static_cast<std::size_t>(child)] = static_cast<int>(i);
      }
    }
  }

  /// The value of "stride" in the node's extras.
  std::string kind(int node) const {
    const tinygltf::Value& extras = at(node).extras;
    return extras.IsObject() ? extras.Get("stride").Get<std::string>() : "";
  }
  std::vector<int> nodes(const std::string& kind, const std::string& name = "") const {
    std::vector<int> found;
    for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
      if (this->kind(i) == kind && (name.empty() || at(i).name == name)) found.push_back(i);
    }
    return found;
  }
  int node(const std::string& kind, const std::string& name) const {
    const auto found = nodes(kind, name);
    INFO(kind << " " << name);
    REQUIRE(found.size() == 1);
    return found[0];
  }
  int lamp(bool on) const {
    for (const int lamp : nodes("lamp")) {
      if (at(lamp).extras.Get("on").Get<bool>() == on) return lamp;
    }
    FAIL("no such lamp");
    return -1;
  }
  const tinygltf::Node& at(int node) const {
    return model.nodes.at(static_cast<std::size_t>(node));
  }

  /// Of a node, at a time [s]; with `scale` 0 nothing of it is seen.
  Eigen::Affine3d pose(int node, double time) const {
    Eigen::Affine3d pose = local(node, time);
    for (int parent = parents_[static_cast<std::size_t>(node)]; parent > 0;
         parent = parents_[static_cast<std::size_t>(parent)]) {
      pose = local(parent, time) * pose;
    }
    return pose;
  }
  bool is_there(int node, double time) const {
    return std::abs(local(node, time).linear().determinant()) > 0.5;
  }

  std::vector<float> floats(int accessor) const {
    const tinygltf::Accessor& list = model.accessors.at(static_cast<std::size_t>(accessor));
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(list.bufferView));
    REQUIRE(list.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT);
    const auto size = list.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                       static_cast<std::uint32_t>(list.type)));
    std::vector<float> numbers(size);
    std::memcpy(numbers.data(), model.buffers[0].data.data() + view.byteOffset + list.byteOffset,
                size * sizeof(float));
    return numbers;
  }
  const tinygltf::Primitive& surface(int node) const {
    return model.meshes.at(static_cast<std::size_t>(at(node).mesh)).primitives.at(0);
  }
  const tinygltf::Material& material(int node) const {
    return model.materials.at(static_cast<std::size_t>(surface(node).material));
  }

  /// The times of the keyframes of a node's property; none if it is not animated.
  std::vector<float> times(int node, const std::string& path) const {
    const auto* channel = find(node, path);
    if (channel == nullptr) return {};
    return floats(sampler(*channel).input);
  }
  std::size_t keyframes() const {
    std::size_t count = 0;
    for (const auto& channel : model.animations[0].channels) {
      count += floats(sampler(channel).input).size();
    }
    return count;
  }
  const tinygltf::Value& notes() const { return notes_of(model.scenes[0].extras); }
  const tinygltf::Value& notes_of(const tinygltf::Value& extras) const {
    return extras.Get("stride");
  }

  tinygltf::Model model;

 private:
  const tinygltf::AnimationSampler& sampler(const tinygltf::AnimationChannel& channel) const {
    return model.animations[0].samplers.at(static_cast<std::size_t>(channel.sampler));
  }
  const tinygltf::AnimationChannel* find(int node, const std::string& path) const {
    for (const auto& channel : model.animations[0].channels) {
      if (channel.target_node == node && channel.target_path == path) return &channel;
    }
    return nullptr;
  }

  /// As the specification interpolates.
  std::vector<double> property(int node, const std::string& path, const std::vector<double>& still,
                               double time) const {
    const auto* channel = find(node, path);
    if (channel == nullptr) return still;
    const std::vector<float> times = floats(sampler(*channel).input);
    const std::vector<float> values = floats(sampler(*channel).output);
    const std::size_t size = values.size() / times.size();
    const auto behind = std::upper_bound(times.begin(), times.end(), time);
    const auto next = static_cast<std::size_t>(behind - times.begin());
    const auto value = [&](std::size_t i) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(i * size);
      return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(size));
    };
    if (next == 0) return value(0);
    if (next == times.size() || sampler(*channel).interpolation == "STEP") return value(next - 1);
    const double share = (time - times[next - 1]) / (double{times[next]} - times[next - 1]);
    const std::vector<double> from = value(next - 1);
    const std::vector<double> to = value(next);
    std::vector<double> between(size);
    if (path == "rotation") {
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(from.data()).slerp(share, Eigen::Quaterniond(to.data()));
      return {turn.x(), turn.y(), turn.z(), turn.w()};
    }
    for (std::size_t i = 0; i < size; ++i) between[i] = from[i] + share * (to[i] - from[i]);
    return between;
  }

  Eigen::Affine3d local(int node, double time) const {
    const tinygltf::Node& still = at(node);
    const auto place = property(node, "translation", still.translation, time);
    const auto turn = property(node, "rotation", still.rotation, time);
    const auto scale = property(node, "scale", still.scale, time);
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    if (!place.empty()) pose.translate(Eigen::Vector3d(place.data()));
    if (!turn.empty()) pose.rotate(Eigen::Quaterniond(turn.data()).normalized());
    if (!scale.empty()) pose.scale(Eigen::Vector3d(scale.data()));
    return pose;
  }

  std::vector<int> parents_;
};

}  // namespace stride::tests

#endif
