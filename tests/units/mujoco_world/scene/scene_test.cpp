#include "units/mujoco_world/scene/scene.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/at.h"
#include "tests/scratch_folder.h"
#include "tests/units/mujoco_world/scene/glb.h"
#include "tests/units/mujoco_world/states.h"
#include "tests/units/mujoco_world/worlds.h"

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using mujoco_world::World;
using WorldScene = mujoco_world::scene::Scene;
using stride::Duration;
using stride::Time;

namespace {

using stride::tests::at;
using stride::tests::Glb;
using stride::tests::ScratchFolder;
using worlds::saved;

constexpr Duration kEach10Ms = std::chrono::milliseconds(10);

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A world and its scene.
struct Filmed {
  explicit Filmed(const std::string& mjcf, Duration interval = kEach10Ms)
      : folder(mjcf), scene(world, interval, scratch / "world.glb") {}
  void advance(double to, bool stops = false) {
    mujoco_world::advance(world, {&scene}, at(to), stops);
  }
  std::string bytes() {
    scene.write();
    return content_of(scratch / "world.glb");
  }
  Glb glb() {
    scene.write();
    return Glb(scratch / "world.glb");
  }

  worlds::Folder folder;
  World world{folder.path()};
  ScratchFolder scratch;
  WorldScene scene;
};

/// The same world without any of our code.
class Reference {
 public:
  explicit Reference(const fs::path& folder)
      : model(mj_loadXML((folder / "scene.xml").c_str(), nullptr, nullptr, 0)),
        data(mj_makeData(model)) {}
  ~Reference() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  void advance(double to) {
    while (data->time < to - 1e-9) mj_step(model, data);
    mj_kinematics(model, data);
  }

  mjModel* model;
  mjData* data;
};

/// How far a pose is from that of MuJoCo's body [m], [rad].
std::pair<double, double> distance_from(const Eigen::Affine3d& pose, const mjData& data, int body) {
  const double* q = data.xquat + 4 * body;
  const Eigen::Quaterniond shown(pose.rotation());
  return {(pose.translation() - Eigen::Vector3d(data.xpos + 3 * body)).norm(),
          shown.angularDistance(Eigen::Quaterniond(q[0], q[1], q[2], q[3]))};
}

/// A chain of bodies that swing, each with a name.
const std::string kChain = R"(
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <worldbody>
    <body name="upper" pos="0 0 2">
      <joint name="shoulder" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02"/>
      <body name="lower" pos="0 0 -0.5">
        <joint name="elbow" axis="1 0.5 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.5" size="0.02"/>
        <body name="hand" pos="0 0 -0.5" euler="0 0 0.5"><geom size="0.05" mass="1"/></body>
      </body>
    </body>
    <body name="stone" pos="1 0 3">
      <freejoint/>
      <geom type="box" size="0.1 0.2 0.3"/>
    </body>
    <geom type="plane" size="2 2 0.1"/>
  </worldbody>
  <keyframe><key name="start" qpos="1.5 0.5  1 0 3 0.8 0.6 0 0"/></keyframe>
</mujoco>)";

std::array<double, 6> box_of(const Glb& glb, int node) {
  const auto& positions =
      glb.model.accessors.at(static_cast<std::size_t>(glb.surface(node).attributes.at("POSITION")));
  const auto& low = positions.minValues;
  const auto& high = positions.maxValues;
  return {low[0], low[1], low[2], high[0], high[1], high[2]};
}

void check_box(const Glb& glb, const std::string& geom, double x, double y, double low,
               double high) {
  INFO(geom);
  const auto nodes = glb.nodes(geom == "sphere" ? "lamp" : "geom", geom);
  REQUIRE_FALSE(nodes.empty());
  const auto box = box_of(glb, nodes[0]);
  const std::array<double, 6> expected{-x, -y, low, x, y, high};
  for (std::size_t i = 0; i < 6; ++i) CHECK(box[i] == Approx(expected[i]).margin(1e-6));
}

Eigen::Vector3d vertex(const std::vector<float>& all, std::uint16_t i) {
  return Eigen::Vector3d(all[3U * i], all[3U * i + 1], all[3U * i + 2]);
}

/// Calls visit(i, j, k) with the vertices of each triangle.
template <class Visit>
void for_each_triangle(const Glb& glb, int node, Visit visit) {
  const auto index = static_cast<std::size_t>(glb.surface(node).indices);
  const auto& list = glb.model.accessors.at(index);
  const auto& view = glb.model.bufferViews.at(static_cast<std::size_t>(list.bufferView));
  REQUIRE(list.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  std::vector<std::uint16_t> corners(list.count);
  std::memcpy(corners.data(), glb.model.buffers[0].data.data() + view.byteOffset, 2 * list.count);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    visit(corners[i], corners[i + 1], corners[i + 2]);
  }
}

/// The least cosine between a triangle's side that is seen and the normal of one of its corners.
double outward(const Glb& glb, int node) {
  const auto positions = glb.floats(glb.surface(node).attributes.at("POSITION"));
  const auto normals = glb.floats(glb.surface(node).attributes.at("NORMAL"));
  double least = 1;
  for_each_triangle(glb, node, [&](std::uint16_t i, std::uint16_t j, std::uint16_t k) {
    const Eigen::Vector3d a = vertex(positions, i);
    const Eigen::Vector3d seen =
        (vertex(positions, j) - a).cross(vertex(positions, k) - a).normalized();
    for (const std::uint16_t corner : {i, j, k}) {
      least = std::min(least, seen.dot(vertex(normals, corner)));
    }
  });
  return least;
}

/// Of what is closed, if its surface looks outwards; else it is negative.
double volume(const Glb& glb, int node) {
  const auto positions = glb.floats(glb.surface(node).attributes.at("POSITION"));
  double sum = 0;
  for_each_triangle(glb, node, [&](std::uint16_t i, std::uint16_t j, std::uint16_t k) {
    sum += vertex(positions, i).dot(vertex(positions, j).cross(vertex(positions, k))) / 6;
  });
  return sum;
}

}  // namespace

TEST_CASE("bodies are where MuJoCo has them, at ten instants") {
  Filmed filmed(kChain);
  filmed.advance(2);
  const Glb glb = filmed.glb();
  Reference reference(filmed.folder.path());
  mj_resetDataKeyframe(reference.model, reference.data, 0);
  for (int i = 0; i <= 10; ++i) {
    reference.advance(0.2 * i);
    for (int body = 1; body < reference.model->nbody; ++body) {
      const std::string name = mj_id2name(reference.model, mjOBJ_BODY, body);
      const auto [way, turn] =
          distance_from(glb.pose(glb.node("body", name), 0.2 * i), *reference.data, body);
      INFO(name << " at " << 0.2 * i);
      CHECK(way < 1e-6);
      CHECK(turn < 1e-6);
    }
  }
  CHECK(glb.times(glb.node("body", "hand"), "rotation").empty());  // it is fixed to the lower arm
  CHECK(glb.times(glb.node("body", "lower"), "translation").empty());
  CHECK(glb.times(glb.node("body", "lower"), "rotation").size() > 20);
}

TEST_CASE("the world stands upright, and the notes tell of the run") {
  Filmed filmed(kChain, std::chrono::milliseconds(30));
  filmed.world.reset(at(-0.1));
  filmed.advance(0.0714);
  const Glb glb = filmed.glb();
  const tinygltf::Node& root = glb.at(glb.model.scenes[0].nodes[0]);
  CHECK(root.name == "world");
  const Eigen::Vector3d up = Eigen::Quaterniond(root.rotation.data()) * Eigen::Vector3d::UnitZ();
  CHECK((up - Eigen::Vector3d::UnitY()).norm() < 1e-9);
  for (const tinygltf::Value* notes : {&glb.notes(), &glb.notes_of(glb.model.asset.extras)}) {
    CHECK(notes->Get("startTime").Get<std::string>() == "-0.1");
    CHECK(notes->Get("stopTime").Get<std::string>() == "0.0714");
    CHECK(notes->Get("interval").GetNumberAsDouble() == 0.03);
    CHECK(notes->Get("tolerance").GetNumberAsDouble() == 1e-6);
    CHECK(notes->Get("resolution").GetNumberAsDouble() == 0);
    CHECK(notes->Get("samples").GetNumberAsInt() == 8);  // at -0.1, -0.09 … 0.06, 0.0714
  }
  CHECK(glb.times(0, "translation") ==
        std::vector<float>{0, mujoco_world::scene::time_of_keyframe(0.1714)});
}

TEST_CASE("a field is as large as it reaches, and is sampled where it comes and goes") {
  Filmed filmed(worlds::kField, std::chrono::milliseconds(100));
  filmed.advance(0.123);
  filmed.world.set_field(0, 0.5);
  filmed.advance(0.25);
  filmed.world.set_field(0, 0.3);  // at the next pose
  filmed.advance(0.42);
  filmed.world.set_field(0, 0);
  filmed.advance(0.6);
  filmed.world.set_field(0, 0.12345);  // at the instant of a pose
  filmed.advance(0.7);
  filmed.world.set_field(0, 0);
  filmed.scene.show_display();
  const Glb glb = filmed.glb();
  const int field = glb.node("field", "coil");
  const auto reach = [&](double time) {
    const Eigen::Vector3d along = glb.pose(field, time).linear().col(2);
    CHECK(along.norm() == Approx(std::abs(along.x())));
    return along.norm();
  };
  for (const auto& [time, expected] : {std::pair(0.0, 0.0),
                                       {0.122, 0.0},
                                       {0.123, 0.5},
                                       {0.299, 0.5},
                                       {0.3, 0.3},
                                       {0.419, 0.3},
                                       {0.42, 0.0},
                                       {0.599, 0.0},
                                       {0.6, 0.123},
                                       {0.699, 0.123},
                                       {0.7, 0.0}}) {
    INFO(time);
    CHECK(reach(time) == Approx(expected).margin(1e-5));
  }
  const auto& mesh = glb.model.meshes.at(static_cast<std::size_t>(glb.at(field).mesh));
  const auto& material =
      glb.model.materials.at(static_cast<std::size_t>(mesh.primitives.at(0).material));
  CHECK(material.alphaMode == "BLEND");
  const auto& positions = glb.model.accessors.at(
      static_cast<std::size_t>(mesh.primitives.at(0).attributes.at("POSITION")));
  CHECK(positions.maxValues.at(2) == Approx(1));
  CHECK(positions.maxValues.at(0) == Approx(mujoco_world::kFieldWidth).epsilon(0.01));
}

TEST_CASE("a lamp is switched at the very instant") {
  Filmed filmed(worlds::kLamp);
  filmed.advance(0.1234);
  filmed.world.set_lamp(0, true);
  filmed.advance(0.2);
  filmed.world.set_lamp(0, false);
  filmed.advance(0.3);
  filmed.world.set_lamp(0, true);
  filmed.scene.show_display();
  const Glb glb = filmed.glb();
  const int dark = glb.lamp(false);
  const int lit = glb.lamp(true);
  for (const auto& [time, is_on] : {std::pair(0.0, false),
                                    {0.12339, false},
                                    {0.1234, true},
                                    {0.19999, true},
                                    {0.2, false},
                                    {0.29999, false},
                                    {0.3, true}}) {
    INFO(time);
    CHECK(glb.is_there(lit, time) == is_on);
    CHECK(glb.is_there(dark, time) != is_on);
  }
  const auto& shines = glb.material(lit).emissiveFactor;
  CHECK(shines == std::vector<double>{1, 0, 0});
  CHECK(glb.material(dark).emissiveFactor == std::vector<double>{0, 0, 0});
  CHECK(glb.at(lit).children.size() == 1);  // the halo
}

TEST_CASE("each geom has its shape, and surfaces look outwards") {
  World world(EVERY_GEOM);
  const ScratchFolder scratch;
  WorldScene scene(world, kEach10Ms, scratch / "world.glb");
  mujoco_world::advance(world, {&scene}, at(0.1));
  scene.write();
  const Glb glb(scratch / "world.glb");
  check_box(glb, "plane", 3, 2, 0, 0);
  check_box(glb, "sphere", 0.25, 0.25, -0.25, 0.25);
  check_box(glb, "capsule", 0.25, 0.25, -0.75, 0.75);
  check_box(glb, "ellipsoid", 0.25, 0.5, -0.75, 0.75);
  check_box(glb, "cylinder", 0.25, 0.25, -0.5, 0.5);
  check_box(glb, "box", 0.25, 0.5, -0.75, 0.75);
  check_box(glb, "hfield", 2, 1, -0.25, 0.5);
  CHECK(glb.nodes("geom", "unseen").empty());  // its group is not drawn
  CHECK(glb.nodes("geom", "glass").empty());   // nor what is wholly transparent
  for (const int node : glb.nodes("geom")) {
    if (glb.at(node).name == "mesh") continue;  // MuJoCo's normals of sharp edges are coarse
    INFO(glb.at(node).name);
    CHECK(outward(glb, node) > 0);
  }
  CHECK(volume(glb, glb.node("geom", "mesh")) == Approx(1).epsilon(1e-5));
  CHECK(volume(glb, glb.node("geom", "box")) == Approx(8 * 0.25 * 0.5 * 0.75));
  CHECK(volume(glb, glb.node("geom", "cylinder")) == Approx(0.19635).epsilon(0.02));
  // 4 m by 2 m, 0.25 m deep, and what is above that, by its triangles
  CHECK(volume(glb, glb.node("geom", "hfield")) == Approx(8 * 0.25 + 1.47222).epsilon(1e-5));
  CHECK(outward(glb, glb.lamp(true)) > 0.9);
}

TEST_CASE("a mesh has its vertices in the world, its texture and its places in it") {
  World world(EVERY_GEOM);
  const ScratchFolder scratch;
  WorldScene scene(world, kEach10Ms, scratch / "world.glb");
  mujoco_world::advance(world, {&scene}, at(0.1));
  scene.write();
  const Glb glb(scratch / "world.glb");
  const int mesh = glb.node("geom", "mesh");
  const auto positions = glb.floats(glb.surface(mesh).attributes.at("POSITION"));
  const auto places = glb.floats(glb.surface(mesh).attributes.at("TEXCOORD_0"));
  REQUIRE(places.size() / 2 == positions.size() / 3);
  // in the body's frame, where the MJCF has them: u is x, v is y / 2
  const Eigen::Affine3d in_body =
      glb.pose(glb.node("body", "swing"), 0).inverse() * glb.pose(mesh, 0);
  for (std::size_t i = 0; i < places.size() / 2; ++i) {
    const Eigen::Vector3d place =
        in_body * Eigen::Vector3d(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    CHECK(place.x() == Approx(places[2 * i]).margin(1e-6));
    CHECK(place.y() == Approx(2 * places[2 * i + 1]).margin(1e-6));
  }
  const tinygltf::Material& checked = glb.material(mesh);
  CHECK(checked.name == "checked");
  const auto& texture = glb.model.textures.at(
      static_cast<std::size_t>(checked.pbrMetallicRoughness.baseColorTexture.index));
  const tinygltf::Image& image = glb.model.images.at(static_cast<std::size_t>(texture.source));
  CHECK(image.width == 16);
  CHECK(image.height == 8);
  CHECK(image.component == 4);
  const std::vector<unsigned char> first(image.image.begin(), image.image.begin() + 3);
  const std::vector<unsigned char> red{255, 0, 0};
  const std::vector<unsigned char> blue{0, 0, 255};
  CHECK((first == red || first == blue));
  const auto on_plane =
      glb.floats(glb.surface(glb.node("geom", "plane")).attributes.at("TEXCOORD_0"));
  CHECK(*std::max_element(on_plane.begin(), on_plane.end()) -
            *std::min_element(on_plane.begin(), on_plane.end()) >=
        4);
}

TEST_CASE("materials are what glTF has of MuJoCo's") {
  World world(EVERY_GEOM);
  const ScratchFolder scratch;
  WorldScene scene(world, kEach10Ms, scratch / "world.glb");
  scene.begin();
  const Glb glb(scratch / "world.glb");
  const auto& wooden = glb.material(glb.node("geom", "box"));
  CHECK(wooden.alphaMode == "BLEND");
  const auto& colour = wooden.pbrMetallicRoughness.baseColorFactor;
  CHECK(colour[0] == Approx(1));
  CHECK(colour[1] == Approx(0.214).margin(0.003));  // 0.5 of sRGB
  CHECK(colour[2] == 0);
  CHECK(colour[3] == 0.5);
  CHECK(wooden.pbrMetallicRoughness.roughnessFactor == 1);  // it has no highlight
  const auto& lit = glb.material(glb.node("geom", "cylinder"));
  CHECK(lit.emissiveFactor[1] == Approx(0.214).margin(0.001));
  CHECK(lit.pbrMetallicRoughness.roughnessFactor == Approx(std::pow(2.0 / 130, 0.25)));
  CHECK(lit.alphaMode != "BLEND");
}

TEST_CASE("cameras, lights and sites are on their bodies, or where they look from") {
  World world(EVERY_GEOM);
  const ScratchFolder scratch;
  WorldScene scene(world, kEach10Ms, scratch / "world.glb");
  mujoco_world::advance(world, {&scene}, at(1));
  scene.write();
  const Glb glb(scratch / "world.glb");
  const tinygltf::Node& fixed = glb.at(glb.node("camera", "fixed"));
  const auto& lens = glb.model.cameras.at(static_cast<std::size_t>(fixed.camera));
  CHECK(lens.perspective.yfov == Approx(50 * 3.14159265358979 / 180));
  CHECK(fixed.translation == std::vector<double>{1, 2, 3});
  const int swing = glb.node("body", "swing");
  const auto& children = glb.at(swing).children;
  for (const auto& [kind, name] : {std::pair("camera", "carried"), {"site", "tip"}}) {
    CHECK(std::count(children.begin(), children.end(), glb.node(kind, name)) == 1);
  }
  const int tracker = glb.node("camera", "tracker");
  for (const double time : {0.0, 0.25, 1.0}) {
    const Eigen::Affine3d pose = glb.pose(tracker, time);
    const Eigen::Vector3d to_body = (glb.pose(swing, time).translation() - pose.translation());
    CHECK((pose.linear() * -Eigen::Vector3d::UnitZ()).dot(to_body.normalized()) > 0.9);
  }
  CHECK(glb.model.lights.size() == 3);
  const int spot = glb.node("light", "spot");
  const Eigen::Vector3d direction = glb.pose(spot, 0).linear() * -Eigen::Vector3d::UnitZ();
  CHECK((direction - Eigen::Vector3d(0, 1, -1).normalized()).norm() < 1e-6);
}

TEST_CASE("contacts are where MuJoCo has them, with their normal, as long as they are there") {
  Filmed filmed(worlds::kBounce, std::chrono::milliseconds(100));
  int changes = 0;
  while (filmed.world.now() < at(0.5)) {
    changes += mujoco_world::advance(filmed.world, {&filmed.scene}, at(0.5), true) ? 1 : 0;
  }
  REQUIRE(changes > 1);
  const Glb glb = filmed.glb();
  const int contact = glb.node("contact", "contact.0");
  CHECK(glb.nodes("contact").size() == 1);
  const auto times = glb.times(contact, "scale");
  REQUIRE(times.size() == static_cast<std::size_t>(changes) + 1);
  CHECK(times[1] == mujoco_world::scene::time_of_keyframe(0.226));  // the grid point, see unit_test
  CHECK_FALSE(glb.is_there(contact, 0.2259));
  CHECK(glb.is_there(contact, 0.226));
  const Eigen::Affine3d pose = glb.pose(contact, 0.226);
  CHECK(std::abs(pose.translation().z()) < 0.01);
  CHECK(std::abs(pose.linear().col(2).z()) > 0.999);
  CHECK(pose.linear().determinant() == Approx(1));
}

TEST_CASE("a scene does not depend on how time is cut into steps") {
  Filmed whole(worlds::kTumble);
  whole.advance(0.9);
  const std::string expected = whole.bytes();
  const unsigned seed = GENERATE(1U, 2U, 3U);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> decades(8, 11);
  Filmed split(worlds::kTumble);
  while (split.world.now() < at(0.9)) {
    const Duration step(std::llround(std::pow(10.0, decades(random))));
    mujoco_world::advance(split.world, {&split.scene}, std::min(at(0.9), split.world.now() + step));
  }
  CHECK((split.bytes() == expected));
}

TEST_CASE("a scene does not show steps that were undone") {
  Filmed straight(worlds::kTumble);
  straight.advance(0.5);
  Filmed wandering(worlds::kTumble);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> length(0.001, 0.1);
  while (wandering.world.now() < at(0.5)) {
    const double now = stride::to_seconds(wandering.world.now());
    const auto before = saved(wandering.world);
    const auto scene = wandering.scene.state();
    wandering.world.set_input(0, 2);  // another way than the one that counts
    wandering.advance(now + length(random));
    wandering.world.restore(before.data());
    REQUIRE(wandering.scene.go_on(scene));
    wandering.world.set_input(0, 0);
    wandering.advance(std::min(0.5, now + length(random)));
  }
  CHECK((wandering.bytes() == straight.bytes()));
}

TEST_CASE("what was undone is gone from the file at once") {
  Filmed tumble(worlds::kTumble);
  tumble.advance(0.05);
  const std::string before = tumble.bytes();
  const auto world = saved(tumble.world);
  const auto scene = tumble.scene.state();
  tumble.advance(0.3);
  CHECK((tumble.bytes() != before));
  tumble.world.restore(world.data());
  REQUIRE(tumble.scene.go_on(scene));
  CHECK((content_of(tumble.scratch / "world.glb") == before));
}

TEST_CASE("a scene goes on in another world that gets its state, and the keyframes of then") {
  Filmed whole(worlds::kTumble);
  whole.advance(0.9);
  const double cut = GENERATE(0.0, 0.3, 0.3141);
  Filmed first(worlds::kTumble);
  first.advance(cut);
  const auto world = saved(first.world);
  const auto state = first.scene.state();
  first.advance(0.7);  // which is not known to have happened
  World other(first.folder.path());
  WorldScene scene(other, kEach10Ms, first.scratch / "world.glb");
  other.restore(world.data());
  REQUIRE(scene.go_on(state));
  mujoco_world::advance(other, {&scene}, at(0.9));
  scene.write();
  CHECK((content_of(first.scratch / "world.glb") == whole.bytes()));
}

TEST_CASE("a scene whose keyframes are gone goes on, and says so") {
  Filmed first(worlds::kTumble);
  first.advance(0.2);
  const auto world = saved(first.world);
  const auto state = first.scene.state();
  fs::remove(first.scratch / "world.keys");
  World other(first.folder.path());
  WorldScene scene(other, kEach10Ms, first.scratch / "world.glb");
  other.restore(world.data());
  CHECK_FALSE(scene.go_on(state));
  mujoco_world::advance(other, {&scene}, at(0.3));
  scene.write();
  const Glb glb(first.scratch / "world.glb");
  CHECK(glb.notes().Get("startTime").Get<std::string>() == "0");
  CHECK(glb.notes().Get("stopTime").Get<std::string>() == "0.3");
}

TEST_CASE("a scene that has not begun leaves the one that is there, until it begins") {
  Filmed first(worlds::kTumble);
  first.advance(0.2);
  const std::string before = first.bytes();
  World world(first.folder.path());
  {
    WorldScene scene(world, kEach10Ms, first.scratch / "world.glb");
    CHECK(scene.go_on({}));
  }
  CHECK((content_of(first.scratch / "world.glb") == before));
  WorldScene scene(world, kEach10Ms, first.scratch / "world.glb");
  mujoco_world::advance(world, {&scene}, at(0.01));
  CHECK((content_of(first.scratch / "world.glb") != before));
}

TEST_CASE("a scene is whole from its beginning, and without an end") {
  const worlds::Folder folder(worlds::kRunaway);
  World world(folder.path());
  const ScratchFolder scratch;
  {
    WorldScene scene(world, kEach10Ms, scratch / "world.glb");
    scene.begin();
    CHECK(Glb(scratch / "world.glb").notes().Get("stopTime").Get<std::string>() == "0");
    world.set_input(0, 1);
    CHECK_THROWS_WITH(mujoco_world::advance(world, {&scene}, at(1000)), Contains("diverged"));
  }
  const Glb glb(scratch / "world.glb");
  CHECK(glb.notes().Get("samples").GetNumberAsInt() > 20);
  CHECK(glb.times(0, "translation").back() > 0.2F);
  CHECK_FALSE(fs::exists(scratch / "world.glb.part"));
}

TEST_CASE("a world in which nothing moves has two keyframes") {
  Filmed still(worlds::kLamp);
  still.advance(10);
  CHECK(still.glb().keyframes() == 2);
}

TEST_CASE("a long chaotic run stays within its limits, and its poses within the tolerance") {
  const worlds::Folder folder(kChain);
  World world(folder.path());
  const ScratchFolder scratch;
  mujoco_world::scene::AnimationLimits limits;
  limits.keyframes = 2000;
  WorldScene scene(world, kEach10Ms, scratch / "world.glb", limits);
  mujoco_world::advance(world, {&scene}, at(30));
  scene.write();
  const Glb glb(scratch / "world.glb");
  CHECK(glb.keyframes() < 2100);
  const double tolerance = glb.notes().Get("tolerance").GetNumberAsDouble();
  CHECK(tolerance > 1e-6);
  Reference reference(folder.path());
  mj_resetDataKeyframe(reference.model, reference.data, 0);
  double most = 0;
  for (int i = 0; i <= 3000; i += 7) {
    reference.advance(0.01 * i);
    for (const char* name : {"upper", "stone"}) {  // whose parent is the world
      const int body = mj_name2id(reference.model, mjOBJ_BODY, name);
      const auto [way, turn] =
          distance_from(glb.pose(glb.node("body", name), 0.01 * i), *reference.data, body);
      most = std::max({most, way, turn});
    }
  }
  // times of single precision are up to 2 us early, at some m/s
  CHECK(most <= tolerance + 2e-5);
  CHECK(most > tolerance / 20);
}

TEST_CASE("what a scene needs and does not get is an error with the file") {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  const ScratchFolder scratch;
  CHECK_THROWS_AS(WorldScene(world, Duration{}, scratch / "world.glb"), std::invalid_argument);
  std::ofstream(scratch / "file") << "no folder";
  CHECK_THROWS_WITH(WorldScene(world, kEach10Ms, scratch / "file/world.glb"), Contains("file'"));
  fs::create_directories(scratch / "taken/world.glb.part/in the way");
  CHECK_THROWS_WITH(WorldScene(world, kEach10Ms, scratch / "taken/world.glb"),
                    Contains("cannot write") && Contains("taken/world.glb.part'"));
  WorldScene scene(world, kEach10Ms, scratch / "full/world.glb");
  fs::create_symlink("/dev/full", scratch / "full/world.glb.part");
  CHECK_THROWS_WITH(scene.begin(),
                    Contains("full/world.glb.part'") && Contains("No space left on device"));
}
