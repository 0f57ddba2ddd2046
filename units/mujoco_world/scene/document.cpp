#include "units/mujoco_world/scene/document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "units/mujoco_world/mujoco_api.h"
#include "units/mujoco_world/scene/buffer.h"
#include "units/mujoco_world/scene/looks.h"

namespace mujoco_world::scene {
namespace {

using Json = tinygltf::Value;
using Extras = Json::Object;
using Numbers = std::vector<double>;

Json stride_extras(const std::string& what) { return Json(Extras{{"stride", Json(what)}}); }

Json lamp_extras(bool on) {
  return Json(Extras{{"stride", Json(std::string("lamp"))}, {"on", Json(on)}});
}

/// The name that the MJCF gives, or none.
std::string given_name(const mjModel& model, int type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name == nullptr ? "" : name;
}

Numbers position_of(const double* position) { return {position[0], position[1], position[2]}; }

/// glTF has the real part last.
Numbers rotation_of(const double* quaternion) {
  double unit[4] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
  mju_normalize4(unit);
  return {unit[1], unit[2], unit[3], unit[0]};
}

bool is_hinged(const mjModel& model, int body) {
  return model.body_jntnum[body] > 0 || model.body_mocapid[body] >= 0;
}

bool is_shown(const mjModel& model, int geom) {
  mjvOption options;
  mjv_defaultOption(&options);
  const int group = std::clamp(model.geom_group[geom], 0, mjNGROUP - 1);
  return options.geomgroup[group] != 0 && colour_of(model, geom)[3] > 0;
}

/// How a track is seen: which of a node's properties it animates.
struct Channel {
  std::size_t track;
  int node;
  const char* path;
  bool is_inverse = false;  ///< of a switch: there where it is off
  bool is_size = false;     ///< of a switch: its value is the scale
};

/// What is to be animated, as nodes.
struct Nodes {
  std::vector<Channel> channels;
  std::vector<int> contacts;
};

class Builder {
 public:
  Builder(const mjModel& model, const Animated& animated, tinygltf::Model& document, Nodes& nodes)
      : model_(model),
        animated_(animated),
        document_(document),
        nodes_(nodes),
        looks_(model, document) {}

  void build() {
    document_.buffers.resize(1);
    document_.asset.version = "2.0";
    document_.asset.generator = "stride, mujoco_world";
    add_bodies();
    for (int i = 0; i < model_.ngeom; ++i) {
      if (is_shown(model_, i)) add_geom(i);
    }
    for (int i = 0; i < model_.nsite; ++i) add_site(i);
    for (int i = 0; i < model_.ncam; ++i) add_camera(i);
    for (int i = 0; i < model_.nlight; ++i) add_light(i);
    add_contacts();
    tinygltf::Scene& scene = document_.scenes.emplace_back();
    scene.nodes = {0};
    document_.defaultScene = 0;
  }

 private:
  tinygltf::Node& node(int index) { return document_.nodes[static_cast<std::size_t>(index)]; }

  int add_node(int parent, std::string name) {
    const auto index = static_cast<int>(document_.nodes.size());
    document_.nodes.emplace_back().name = std::move(name);
    if (parent >= 0) node(parent).children.push_back(index);
    return index;
  }

  /// Bodies come first, so that they have their own numbers.
  void add_bodies() {
    for (int i = 0; i < model_.nbody; ++i) {
      const int parent = i == 0 ? -1 : model_.body_parentid[i];
      const int added = add_node(parent, given_name(model_, mjOBJ_BODY, i));
      node(added).extras = stride_extras("body");
      node(added).translation = position_of(model_.body_pos + 3 * i);
      node(added).rotation = rotation_of(model_.body_quat + 4 * i);
    }
    node(0).name = "world";
    node(0).rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // MuJoCo's z is upwards, glTF's y
    for (std::size_t i = 0; i < animated_.bodies.size(); ++i) animate(2 * i, animated_.bodies[i]);
  }

  void animate(std::size_t track, int index) {
    nodes_.channels.push_back({track, index, "translation"});
    nodes_.channels.push_back({track + 1, index, "rotation"});
  }

  void place(int index, const double* position, const double* quaternion) {
    node(index).translation = position_of(position);
    node(index).rotation = rotation_of(quaternion);
  }

  void add_geom(int geom) {
    const auto lamp = std::find(animated_.lamps.begin(), animated_.lamps.end(), geom);
    const bool is_lamp = lamp != animated_.lamps.end();
    const int mesh = looks_.mesh_of(geom);
    if (mesh < 0) return;
    const int added = add_geom_node(geom, mesh);
    if (!is_lamp) return;
    const int lit = add_geom_node(geom, looks_.lit_mesh_of(geom));
    node(added).extras = lamp_extras(false);
    node(lit).extras = lamp_extras(true);
    if (const int halo = looks_.halo_of(geom); halo >= 0) node(add_node(lit, "")).mesh = halo;
    const auto number = static_cast<std::size_t>(lamp - animated_.lamps.begin());
    const std::size_t track = animated_.first_lamp() + number;
    nodes_.channels.push_back({track, added, "scale", true});
    nodes_.channels.push_back({track, lit, "scale"});
  }

  int add_geom_node(int geom, int mesh) {
    const int added = add_node(model_.geom_bodyid[geom], given_name(model_, mjOBJ_GEOM, geom));
    node(added).mesh = mesh;
    node(added).extras = stride_extras("geom");
    place(added, model_.geom_pos + 3 * geom, model_.geom_quat + 4 * geom);
    return added;
  }

  void add_site(int site) {
    const std::string name = given_name(model_, mjOBJ_SITE, site);
    if (name.empty()) return;
    const int added = add_node(model_.site_bodyid[site], name);
    node(added).extras = stride_extras("site");
    place(added, model_.site_pos + 3 * site, model_.site_quat + 4 * site);
    const auto& fields = animated_.fields;
    const auto field = std::find(fields.begin(), fields.end(), site);
    if (field == fields.end()) return;
    const int drawn = add_node(added, name);
    node(drawn).mesh = looks_.field_of(site);
    node(drawn).extras = stride_extras("field");
    const auto number = static_cast<std::size_t>(field - fields.begin());
    nodes_.channels.push_back({animated_.first_field() + number, drawn, "scale", false, true});
  }

  /// Both look along -z, y upwards.
  void add_camera(int camera) {
    tinygltf::Camera& lens = document_.cameras.emplace_back();
    lens.name = given_name(model_, mjOBJ_CAMERA, camera);
    const double near = model_.vis.map.znear * model_.stat.extent;
    const double far = model_.vis.map.zfar * model_.stat.extent;
    if (api::is_orthographic(&model_, camera)) {
      lens.type = "orthographic";
      lens.orthographic.ymag = model_.cam_fovy[camera] / 2;
      lens.orthographic.xmag = lens.orthographic.ymag;
      lens.orthographic.znear = near;
      lens.orthographic.zfar = far;
    } else {
      lens.type = "perspective";
      lens.perspective.yfov = model_.cam_fovy[camera] * mjPI / 180;
      lens.perspective.znear = near;
      lens.perspective.zfar = far;
    }
    const int added = add_follower(mjOBJ_CAMERA, camera, model_.cam_bodyid[camera],
                                   animated_.cameras, animated_.bodies.size());
    node(added).camera = static_cast<int>(document_.cameras.size()) - 1;
    node(added).extras = stride_extras("camera");
    place(added, model_.cam_pos + 3 * camera, model_.cam_quat + 4 * camera);
  }

  /// On its body, or on the world where it follows something.
  int add_follower(int type, int id, int body, const std::vector<int>& followers,
                   std::size_t before) {
    const auto found = std::find(followers.begin(), followers.end(), id);
    const bool follows = found != followers.end();
    const int added = add_node(follows ? 0 : body, given_name(model_, type, id));
    if (follows) animate(2 * (before + static_cast<std::size_t>(found - followers.begin())), added);
    return added;
  }

  /// MuJoCo's lights do not get weaker with the distance unless the model says so, glTF's do: they
  /// are as strong as MuJoCo's at the distance of the model's middle. A white surface that faces
  /// a light of pi is white.
  void add_light(int light) {
    if (!model_.light_active[light]) return;
    const api::LightType type = api::light_type(&model_, light);
    tinygltf::Light& lamp = document_.lights.emplace_back();
    lamp.name = given_name(model_, mjOBJ_LIGHT, light);
    const float* diffuse = model_.light_diffuse + 3 * light;
    const double most = std::max(*std::max_element(diffuse, diffuse + 3), 1e-6F);
    for (int k = 0; k < 3; ++k) lamp.color.push_back(linear(diffuse[k] / most));
    lamp.intensity = mjPI * linear(most);
    lamp.type = type.is_directional ? "directional" : type.is_spot ? "spot" : "point";
    if (!type.is_directional) {
      double way[3];
      mju_sub3(way, model_.light_pos0 + 3 * light, model_.stat.center);
      lamp.intensity *= std::max(mju_dot3(way, way), 1e-6);
    }
    if (type.is_spot) {
      lamp.spot.innerConeAngle = 0;
      lamp.spot.outerConeAngle =
          std::clamp(model_.light_cutoff[light] * mjPI / 180, 1e-3, mjPI / 2);
    }
    const auto before = animated_.bodies.size() + animated_.cameras.size();
    const int added =
        add_follower(mjOBJ_LIGHT, light, model_.light_bodyid[light], animated_.lights, before);
    const auto number = static_cast<int>(document_.lights.size()) - 1;
    node(added).extensions["KHR_lights_punctual"] = Json(Extras{{"light", Json(number)}});
    node(added).extras = stride_extras("light");
    double quaternion[4];
    light_orientation(model_.light_dir + 3 * light, quaternion);
    place(added, model_.light_pos + 3 * light, quaternion);
  }

  void add_contacts() {
    for (std::size_t i = 0; i < animated_.contacts; ++i) {
      const int added = add_node(0, "contact." + std::to_string(i));
      node(added).extras = stride_extras("contact");
      nodes_.contacts.push_back(added);
      const std::size_t track = animated_.first_contact() + 3 * i;
      nodes_.channels.push_back({track, added, "translation"});
      nodes_.channels.push_back({track + 1, added, "rotation"});
      nodes_.channels.push_back({track + 2, added, "scale"});
    }
  }

  const mjModel& model_;
  const Animated& animated_;
  tinygltf::Model& document_;
  Nodes& nodes_;
  Looks looks_;
};

/// Adds the keyframes of one property of a node.
class AnimationWriter {
 public:
  AnimationWriter(tinygltf::Model& document, const std::vector<TrackType>& types)
      : document_(document), types_(types) {
    animation_.name = "run";
  }

  /// Puts a node where it is in the beginning, and animates it if it changes.
  void add(const Channel& channel, const std::vector<TimedValue>& timeline) {
    if (timeline.empty()) return;
    const std::string path = channel.path;
    const bool is_scale = path == "scale";
    std::vector<float> times;
    std::vector<float> values;
    for (const TimedValue& keyframe : timeline) {
      const bool is_again = !times.empty() && times.back() == keyframe.time;
      if (is_again) values.resize(values.size() - (path == "rotation" ? 4 : 3));
      if (!is_again) times.push_back(keyframe.time);
      if (is_scale) {
        values.insert(values.end(), 3, scale_of(channel, keyframe.value[0]));
      } else {
        values.insert(values.end(), keyframe.value.begin(),
                      keyframe.value.begin() + (path == "rotation" ? 4 : 3));
      }
    }
    auto& node = document_.nodes[static_cast<std::size_t>(channel.node)];
    Numbers& still = is_scale ? node.scale : path == "rotation" ? node.rotation : node.translation;
    const std::size_t components = values.size() / times.size();
    still.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(components));
    if (times.size() < 2) return;
    add(channel.node, path, times, values, types_[channel.track] == TrackType::Switch);
  }

  /// The animation lasts as long as the run, whatever moves.
  void add_duration(float duration) {
    std::vector<float> times{0};
    if (duration > 0) times.push_back(duration);
    add(0, "translation", times, std::vector<float>(3 * times.size()), false);
  }

  void finish() { document_.animations.push_back(std::move(animation_)); }

 private:
  static float scale_of(const Channel& channel, float value) {
    if (channel.is_size) return value;
    return (value != 0) != channel.is_inverse ? 1.0F : 0.0F;
  }

  void add(int node, const std::string& path, const std::vector<float>& times,
           const std::vector<float>& values, bool is_stepped) {
    tinygltf::AnimationSampler& sampler = animation_.samplers.emplace_back();
    if (times != last_times_ || last_input_ < 0) {
      last_input_ = add_floats(document_, times, TINYGLTF_TYPE_SCALAR);
      last_times_ = times;
    }
    sampler.input = last_input_;
    sampler.output =
        add_floats(document_, values, path == "rotation" ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
    sampler.interpolation = is_stepped ? "STEP" : "LINEAR";
    tinygltf::AnimationChannel& channel = animation_.channels.emplace_back();
    channel.sampler = static_cast<int>(animation_.samplers.size()) - 1;
    channel.target_node = node;
    channel.target_path = path;
  }

  tinygltf::Model& document_;
  const std::vector<TrackType>& types_;
  tinygltf::Animation animation_;
  std::vector<float> last_times_;
  int last_input_ = -1;
};

Json extras_of(const RunNotes& notes) {
  return Json(
      Extras{{"stride", Json(Extras{{"startTime", Json(notes.start_time)},
                                    {"stopTime", Json(notes.stop_time)},
                                    {"interval", Json(notes.interval)},
                                    {"tolerance", Json(notes.tolerance)},
                                    {"resolution", Json(notes.resolution)},
                                    {"samples", Json(static_cast<int>(std::min<std::uint64_t>(
                                                    notes.samples, 2147483647)))}})}});
}

/// How many contacts were there at once, at most.
std::size_t used_contacts(const Animated& animated,
                          const std::vector<std::vector<TimedValue>>& tracks) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < animated.contacts; ++i) {
    const auto& there = tracks[animated.first_contact() + 3 * i + 2];
    const auto is_on = [](const TimedValue& keyframe) { return keyframe.value[0] != 0; };
    if (std::any_of(there.begin(), there.end(), is_on)) used = i + 1;
  }
  return used;
}

}  // namespace

void light_orientation(const double* direction, double* quaternion) {
  const double back[3] = {-direction[0], -direction[1], -direction[2]};
  mju_quatZ2Vec(quaternion, back);
}

std::vector<TrackType> Animated::tracks() const {
  std::vector<TrackType> types;
  for (std::size_t i = 0; i < first_lamp(); ++i) {
    types.push_back(i % 2 == 0 ? TrackType::Point : TrackType::Rotation);
  }
  types.resize(first_contact() + 3 * contacts, TrackType::Switch);
  return types;
}

Animated animated_of(const mjModel& model, const Catalogue& catalogue) {
  constexpr std::size_t kMostContacts = 64;
  Animated animated;
  for (int i = 1; i < model.nbody; ++i) {
    if (is_hinged(model, i)) animated.bodies.push_back(i);
  }
  for (int i = 0; i < model.ncam; ++i) {
    if (model.cam_mode[i] != mjCAMLIGHT_FIXED) animated.cameras.push_back(i);
  }
  for (int i = 0; i < model.nlight; ++i) {
    if (model.light_mode[i] != mjCAMLIGHT_FIXED) animated.lights.push_back(i);
  }
  for (const Lamp& lamp : catalogue.lamps) animated.lamps.push_back(lamp.geom);
  for (const Field& field : catalogue.fields) animated.fields.push_back(field.site);
  animated.contacts = kMostContacts;
  return animated;
}

struct Document::Still {
  tinygltf::Model document;
  Nodes nodes;
  std::vector<TrackType> types;
};

Document::Document(const mjModel& model, Animated animated)
    : animated_(std::move(animated)), still_(std::make_unique<Still>()) {
  still_->types = animated_.tracks();
  Builder(model, animated_, still_->document, still_->nodes).build();
}

Document::~Document() = default;

std::string Document::bytes(const std::vector<std::vector<TimedValue>>& tracks,
                            const RunNotes& notes) const {
  tinygltf::Model document = still_->document;
  document.asset.extras = document.scenes.front().extras = extras_of(notes);
  const std::size_t contacts = used_contacts(animated_, tracks);
  AnimationWriter writer(document, still_->types);
  writer.add_duration(notes.duration);
  for (const Channel& channel : still_->nodes.channels) {
    if (channel.track >= animated_.first_contact() + 3 * contacts) continue;
    writer.add(channel, tracks[channel.track]);
  }
  writer.finish();
  // the nodes of contacts that were never there are the last ones
  const std::size_t unused = animated_.contacts - contacts;
  auto& of_world = document.nodes.front().children;
  of_world.resize(of_world.size() - unused);
  document.nodes.resize(document.nodes.size() - unused);
  std::ostringstream stream;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&document, stream, false, true);
  return stream.str();
}

}  // namespace mujoco_world::scene
