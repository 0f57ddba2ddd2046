#include "master/report/world_file.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stride::report {
namespace {

using nlohmann::json;

struct Mistake : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class... Values>
[[noreturn]] void fail(fmt::format_string<Values...> format, Values&&... values) {
  throw Mistake(fmt::format(format, std::forward<Values>(values)...));
}

/// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html#binary-gltf-layout
struct Chunks {
  std::string text;    ///< JSON
  std::string binary;  ///< what follows that
};

class Reader {
 public:
  explicit Reader(std::FILE* file) : file_(file) {}

  std::string bytes(std::size_t count) {
    std::string read(count, '\0');
    read.resize(std::fread(read.data(), 1, count, file_));
    return read;
  }

  /// Little-endian.
  std::uint32_t number() {
    const std::string read = bytes(4);
    if (read.size() < 4) fail("it is cut off");
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(read[i]);
    return value;
  }

 private:
  std::FILE* file_;
};

Chunks read_chunks(std::FILE* file, std::uintmax_t size) {
  constexpr std::string_view kBegin("glTF\2\0\0\0", 8);
  constexpr std::uint64_t kHeader = 12;
  constexpr std::uint64_t kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4E4F534A;
  constexpr std::uint32_t kBinary = 0x004E4942;
  if (size > kLargestWorld) fail("it is larger than {} MiB", kLargestWorld >> 20);
  Reader reader(file);
  if (reader.bytes(kBegin.size()) != kBegin) fail("it is no binary glTF 2.0 file");
  if (const std::uint32_t length = reader.number(); length != size) {
    fail("it has {} bytes, but its header says {}", size, length);
  }
  const std::uint64_t text = reader.number();
  const std::uint64_t behind = kHeader + kChunkHeader + text;
  if (reader.number() != kJson || behind > size) fail("it does not begin with JSON");
  Chunks chunks;
  chunks.text = reader.bytes(text);
  if (chunks.text.size() != text) fail("it is cut off");
  if (behind + kChunkHeader > size) return chunks;
  const std::uint64_t binary = reader.number();
  if (reader.number() != kBinary || behind + kChunkHeader + binary > size) {
    fail("what follows its JSON is not as long as it says, or no binary data");
  }
  chunks.binary = reader.bytes(binary);
  if (chunks.binary.size() != binary) fail("it is cut off");
  return chunks;
}

/// What the JSON refers to is there.
class Content {
 public:
  explicit Content(const Chunks& chunks)
      : root_(json::parse(chunks.text, nullptr, false)), binary_(chunks.binary) {
    if (!root_.is_object()) fail("its JSON is not well-formed, or no object");
  }

  void check() const {
    check_versions();
    check_buffers();
    check_views();
    check_accessors();
    check_images();
    check_meshes();
    check_skins();
    check_animations();
    check_nodes();
  }

 private:
  /// A member of this type; an empty one where there is none.
  static const json& part(const json& object, const char* name, const json& none) {
    const auto found = object.find(name);
    if (found == object.end()) return none;
    if (found->type() != none.type()) {
      fail("'{}' is no {}", name, none.is_array() ? "list" : "object");
    }
    return *found;
  }
  static const json& member(const json& object, const char* name) {
    static const json none = json::object();
    return part(object, name, none);
  }
  static const json& list(const json& object, const char* name) {
    static const json none = json::array();
    return part(object, name, none);
  }
  static const json& objects(const json& object, const char* name) {
    const json& all = list(object, name);
    for (const json& each : all) {
      if (!each.is_object()) fail("an entry of '{}' is no object", name);
    }
    return all;
  }
  const json& objects(const char* name) const { return objects(root_, name); }
  /// Of a list that was looked at.
  const json& entry(const char* name, std::uint64_t index) const {
    return list(root_, name)[index];
  }

  static std::optional<std::uint64_t> number(const json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end()) return std::nullopt;
    if (!found->is_number_unsigned()) {
      fail("'{}' is a {}, no index or size", name, found->type_name());
    }
    return found->get<std::uint64_t>();
  }

  void require_index(std::optional<std::uint64_t> index, const char* among) const {
    if (index && *index >= list(root_, among).size()) {
      fail("it refers to number {} of its {} '{}'", *index, list(root_, among).size(), among);
    }
  }
  void require_index(const json& object, const char* name, const char* among) const {
    require_index(number(object, name), among);
  }
  void require_indices(const json& indices, const char* among) const {
    for (const json& index : indices) {
      if (!index.is_number_unsigned()) {
        fail("a {} is no index of '{}'", index.type_name(), among);
      }
      require_index(index.get<std::uint64_t>(), among);
    }
  }
  /// Of an object whose members are indices, such as the attributes of a primitive.
  void require_members(const json& object, const char* name, const char* among) const {
    require_indices(member(object, name), among);
  }

  /// Whether so many bytes from there on are within a length.
  static bool is_within(std::uint64_t offset, std::uint64_t count, std::uint64_t length) {
    return offset <= length && count <= length - offset;
  }

  /// The page cannot decode what is compressed by extensions.
  void check_versions() const {
    const json& asset = member(root_, "asset");
    const auto version = asset.find("version");
    if (version == asset.end() || !version->is_string() ||
        !version->get<std::string>().starts_with("2.")) {
      fail("it is no glTF 2.0");
    }
    for (const json& extension : list(root_, "extensionsRequired")) {
      for (const char* unknown :
           {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu"}) {
        if (extension == unknown)
          fail("it needs the extension {}, which is not known here", unknown);
      }
    }
  }

  void check_buffers() const {
    const json& buffers = objects("buffers");
    if (buffers.size() > 1) fail("it has {} buffers, and can hold one", buffers.size());
    for (const json& buffer : buffers) {
      if (buffer.contains("uri")) fail("its buffer is not its binary part");
      if (number(buffer, "byteLength").value_or(0) > binary_.size()) {
        fail("its buffer has {} bytes, and the file holds {} of them",
             *number(buffer, "byteLength"), binary_.size());
      }
    }
  }

  void check_views() const {
    for (const json& view : objects("bufferViews")) {
      require_index(view, "buffer", "buffers");
      const auto offset = number(view, "byteOffset").value_or(0);
      const auto length = number(view, "byteLength").value_or(0);
      if (!is_within(offset, length, binary_.size())) {
        fail("{} bytes from {} on are not within its buffer", length, offset);
      }
    }
  }

  static std::uint64_t bytes_of_component(const json& object) {
    static const std::map<std::uint64_t, std::uint64_t> sizes = {{5120, 1}, {5121, 1}, {5122, 2},
                                                                 {5123, 2}, {5125, 4}, {5126, 4}};
    const auto size = sizes.find(number(object, "componentType").value_or(0));
    if (size == sizes.end()) fail("an accessor is of no known type");
    return size->second;
  }

  /// Of one element, tightly packed.
  static std::uint64_t bytes_of(const json& accessor) {
    static const std::map<std::string, std::uint64_t> components = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
        {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    const auto type = accessor.find("type");
    if (type == accessor.end() || !type->is_string() ||
        components.count(type->get<std::string>()) == 0) {
      fail("an accessor is of no known type");
    }
    return components.at(type->get<std::string>()) * bytes_of_component(accessor);
  }

  /// So many elements of `size` bytes are in the view that an object has.
  void require_elements(const json& object, std::uint64_t count, std::uint64_t size) const {
    require_index(object, "bufferView", "bufferViews");
    const auto view = number(object, "bufferView");
    if (!view || count == 0) return;
    const json& holder = entry("bufferViews", *view);
    const std::uint64_t length = number(holder, "byteLength").value_or(0);
    const std::uint64_t stride = number(holder, "byteStride").value_or(size);
    const auto offset = number(object, "byteOffset").value_or(0);
    if (!is_within(offset, size, length) ||
        (count > 1 && (stride == 0 || count - 1 > (length - offset - size) / stride))) {
      fail("an accessor has {} elements, more than its {} bytes can be", count, length);
    }
  }

  /// Where the elements of a view begin, and how far apart they are.
  struct Place {
    std::uint64_t begin, stride;
  };
  Place place_of(const json& object, std::uint64_t size) const {
    const json& holder = entry("bufferViews", *number(object, "bufferView"));
    return {number(holder, "byteOffset").value_or(0) + number(object, "byteOffset").value_or(0),
            number(holder, "byteStride").value_or(size)};
  }

  /// Of integers that were found to be there.
  void require_below(const json& object, std::uint64_t count, std::uint64_t limit) const {
    if (!object.contains("bufferView")) return;
    const std::uint64_t size = bytes_of_component(object);
    auto [at, stride] = place_of(object, size);
    for (std::uint64_t i = 0; i < count; ++i, at += stride) {
      std::uint64_t value = 0;
      for (std::uint64_t k = size; k-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(binary_[at + k]);
      }
      if (value >= limit) fail("it refers to element {} of {}", value, limit);
    }
  }

  void check_accessors() const {
    for (const json& accessor : objects("accessors")) {
      const auto count = number(accessor, "count").value_or(0);
      require_elements(accessor, count, bytes_of(accessor));
      const json& sparse = member(accessor, "sparse");
      const auto others = number(sparse, "count").value_or(0);
      if (others > count) fail("an accessor has {} elements, and others for {}", count, others);
      if (others == 0) continue;
      const json& places = member(sparse, "indices");
      require_elements(places, others, bytes_of_component(places));
      require_below(places, others, count);
      require_elements(member(sparse, "values"), others, bytes_of(accessor));
    }
  }

  void check_images() const {
    for (const json& image : objects("images")) {
      if (image.contains("uri")) fail("one of its images is not in its binary part");
      require_index(image, "bufferView", "bufferViews");
    }
    for (const json& texture : objects("textures")) {
      require_index(texture, "source", "images");
      require_index(texture, "sampler", "samplers");
    }
  }

  void check_meshes() const {
    std::set<std::pair<std::uint64_t, std::uint64_t>> used;  // corners and positions
    for (const json& mesh : objects("meshes")) {
      for (const json& primitive : objects(mesh, "primitives")) {
        require_members(primitive, "attributes", "accessors");
        for (const json& target : objects(primitive, "targets")) {
          require_indices(target, "accessors");
        }
        require_index(primitive, "indices", "accessors");
        require_index(primitive, "material", "materials");
        const auto corners = number(primitive, "indices");
        const auto positions = number(member(primitive, "attributes"), "POSITION");
        if (corners && positions) used.emplace(*corners, *positions);
      }
    }
    for (const auto& [indices, positions] : used) {
      const json& corners = entry("accessors", indices);
      require_below(corners, number(corners, "count").value_or(0),
                    number(entry("accessors", positions), "count").value_or(0));
    }
  }

  void check_skins() const {
    for (const json& skin : objects("skins")) {
      require_indices(list(skin, "joints"), "nodes");
      require_index(skin, "skeleton", "nodes");
      require_index(skin, "inverseBindMatrices", "accessors");
    }
  }

  /// Each keyframe has its values. Returns the accessor of the times.
  std::uint64_t check_sampler(const json& sampler) const {
    require_index(sampler, "input", "accessors");
    require_index(sampler, "output", "accessors");
    const auto input = number(sampler, "input");
    const auto output = number(sampler, "output");
    if (!input || !output) fail("a part of its animation has no times, or no values");
    const auto is_cubic = sampler.value("interpolation", json()) == "CUBICSPLINE";
    const json& times = entry("accessors", *input);
    const auto count = number(times, "count").value_or(0);
    const auto values = number(entry("accessors", *output), "count").value_or(0);
    const std::uint64_t each = is_cubic ? 3 : 1;
    if (count == 0 || values < count * each || values % (count * each) != 0) {
      fail("a part of its animation has {} times, but {} values", count, values);
    }
    return *input;
  }

  void require_growth(const json& times) const {
    float last = -std::numeric_limits<float>::infinity();
    for (const float time : floats(times)) {
      if (!(time > last)) fail("the times of its animation do not grow");
      last = time;
    }
  }

  /// Of an accessor that was looked at.
  std::vector<float> floats(const json& accessor) const {
    const auto view = number(accessor, "bufferView");
    if (!view || number(accessor, "componentType") != 5126 ||
        accessor.value("type", "") != "SCALAR") {
      fail("the times of its animation are no float numbers");
    }
    auto [at, stride] = place_of(accessor, sizeof(float));
    std::vector<float> values(number(accessor, "count").value_or(0));
    for (float& value : values) {
      std::memcpy(&value, binary_.data() + at, sizeof value);
      at += stride;
    }
    return values;
  }

  void check_animations() const {
    std::set<std::uint64_t> times;  // many samplers share them
    for (const json& animation : objects("animations")) {
      const std::size_t samplers = objects(animation, "samplers").size();
      for (const json& sampler : objects(animation, "samplers")) {
        times.insert(check_sampler(sampler));
      }
      for (const json& channel : objects(animation, "channels")) {
        if (number(channel, "sampler").value_or(0) >= samplers) fail("a channel has no sampler");
        require_index(member(channel, "target"), "node", "nodes");
      }
    }
    for (const std::uint64_t accessor : times) require_growth(entry("accessors", accessor));
  }

  static void require_numbers(const json& object, const char* name, std::size_t size) {
    const json& all = list(object, name);
    if (!object.contains(name)) return;
    const auto is_number = [](const json& each) { return each.is_number(); };
    if (all.size() != size || !std::all_of(all.begin(), all.end(), is_number)) {
      fail("'{}' are not {} numbers", name, size);
    }
  }

  /// Each has one parent at most, and roots none: so what is below a root is a tree.
  void check_nodes() const {
    const json& nodes = objects("nodes");
    std::vector<bool> has_parent(nodes.size(), false);
    for (const json& node : nodes) {
      require_index(node, "mesh", "meshes");
      require_index(node, "camera", "cameras");
      require_index(node, "skin", "skins");
      for (const auto& [name, size] : std::initializer_list<std::pair<const char*, std::size_t>>{
               {"translation", 3}, {"rotation", 4}, {"scale", 3}, {"matrix", 16}}) {
        require_numbers(node, name, size);
      }
      const json& children = list(node, "children");
      require_indices(children, "nodes");
      for (const json& child : children) {
        const auto index = child.get<std::size_t>();
        if (has_parent[index]) fail("node {} has two parents", index);
        has_parent[index] = true;
      }
    }
    const json& scenes = objects("scenes");
    if (scenes.empty()) fail("it has no scene");
    require_index(root_, "scene", "scenes");
    for (const json& scene : scenes) {
      const json& roots = list(scene, "nodes");
      require_indices(roots, "nodes");
      for (const json& root : roots) {
        if (has_parent[root.get<std::size_t>()]) {
          fail("node {} is a root and has a parent", root.get<std::size_t>());
        }
      }
    }
  }

  json root_;
  const std::string& binary_;
};

}  // namespace

std::string mistake_in_world(std::FILE* file, std::uintmax_t size) {
  try {
    const Chunks chunks = read_chunks(file, size);
    Content(chunks).check();
    return "";
  } catch (const Mistake& mistake) {
    return mistake.what();
  }
}

}  // namespace stride::report
