#include "units/mujoco_world/clearance.h"

#include <memory>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/mjcf.h"

using mujoco_world::Clearance;
using mujoco_world::load_model;
using mujoco_world::ModelPointer;

namespace {

struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// A model at its reference pose, or any other.
struct Scene {
  explicit Scene(const std::string& mjcf)
      : folder(mjcf),
        model(load_model(folder.path() / "scene.xml")),
        data(mj_makeData(model.get())) {
    mj_kinematics(model.get(), data.get());
  }

  void pose(std::mt19937& generator) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < model->nq; ++i) data->qpos[i] = uniform(generator);
    mj_normalizeQuat(model.get(), data->qpos);
    mj_kinematics(model.get(), data.get());
  }
  bool excluded() const { return Clearance(*model).excludes_contact(*model, *data); }
  bool touches() const {
    mj_collision(model.get(), data.get());
    return data->ncon > 0;
  }

  worlds::Folder folder;
  ModelPointer model;
  std::unique_ptr<mjData, DeleteData> data;
};

std::string body(const std::string& geom) {
  return "<body><freejoint/><geom " + geom + "/></body>";
}

Scene above_table(double height, const std::string& more = "", const std::string& attributes = "") {
  return Scene(
      "<mujoco><worldbody><geom name='table' type='box' size='1 1 0.1' pos='0 0 -0.1'/>"
      "<body name='ball' pos='0.7 0.7 " +
      std::to_string(height) + "'><freejoint/><geom name='ball' size='0.1' " + attributes +
      "/></body></worldbody>" + more + "</mujoco>");
}

}  // namespace

TEST_CASE("what is excluded has no contact, whatever the shapes and poses", "[mujoco_world]") {
  Scene scene(
      "<mujoco><worldbody>"
      "<geom type='plane' size='2 2 1' pos='0 0 -0.8'/>"
      "<geom type='box' size='0.4 0.3 0.05' pos='0 0 -0.5' euler='10 20 30'/>" +
      body("type='sphere' size='0.08'") + body("type='capsule' size='0.04 0.1'") +
      body("type='cylinder' size='0.06 0.08' margin='0.02'") +
      body("type='box' size='0.1 0.05 0.02'") + body("type='ellipsoid' size='0.1 0.05 0.02'") +
      "</worldbody></mujoco>");
  const Clearance clearance(*scene.model);
  std::mt19937 generator(1);
  int excluded = 0;
  int touching = 0;
  for (int i = 0; i < 20'000; ++i) {
    scene.pose(generator);
    const bool is_excluded = clearance.excludes_contact(*scene.model, *scene.data);
    const bool touches = scene.touches();
    if (is_excluded) CHECK_FALSE(touches);
    excluded += is_excluded ? 1 : 0;
    touching += touches ? 1 : 0;
  }
  CHECK(excluded > 1000);
  CHECK(touching > 1000);
}

TEST_CASE("a wide table is no nearer than its surface", "[mujoco_world]") {
  CHECK(above_table(0.101).excluded());
  CHECK_FALSE(above_table(0.099).excluded());
  CHECK(above_table(0.099).touches());
  CHECK_FALSE(above_table(0.101, "", "margin='0.01'").excluded());
}

TEST_CASE("what MuJoCo lets through is not an obstacle", "[mujoco_world]") {
  CHECK(above_table(0.05, "", "contype='0' conaffinity='0'").excluded());
}

TEST_CASE("where distances are not known, nothing is excluded", "[mujoco_world]") {
  CHECK(above_table(0.5).excluded());
  CHECK_FALSE(above_table(0.5, "<contact><pair geom1='table' geom2='ball'/></contact>").excluded());
  CHECK_FALSE(Scene("<mujoco><asset><hfield name='hills' nrow='2' ncol='2' size='1 1 0.1 0.1'/>"
                    "</asset><worldbody><geom type='hfield' hfield='hills'/>"
                    "<body pos='0 0 5'><freejoint/><geom size='0.1'/></body></worldbody></mujoco>")
                  .excluded());
}

TEST_CASE("the arm over the sensor is clear of it", "[mujoco_world][arm]") {
  const ModelPointer model =
      load_model(STRIDE_SOURCE_DIR "/scenarios/nfc_approach/world/scene.xml");
  const std::unique_ptr<mjData, DeleteData> data(mj_makeData(model.get()));
  mj_resetDataKeyframe(model.get(), data.get(), 0);
  mj_kinematics(model.get(), data.get());
  CHECK(Clearance(*model).excludes_contact(*model, *data));
}
