#include "units/mujoco_world/robot/convert.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"

using mujoco_world::convert;
using mujoco_world::load_model;
using mujoco_world::load_robot;

namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A tetrahedron.
const std::string kMesh =
    "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

std::string urdf(const std::string& mesh, const std::string& extension = "") {
  return R"(<robot name="arm">)" + extension + R"(
  <link name="base"/>
  <link name="arm">
    <visual><geometry><mesh filename="meshes/pretty.dae"/></geometry></visual>
    <collision><geometry><mesh filename=")" +
         mesh + R"("/></geometry></collision>
    <inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="10" velocity="1"/>
  </joint>
  <joint name="arm_to_tool" type="fixed">
    <origin xyz="0 0 0.5"/><parent link="arm"/><child link="tool"/>
  </joint>
</robot>)";
}

int id(const mjModel& model, mjtObj type, const char* name) {
  return mj_name2id(&model, type, name);
}

}  // namespace

TEST_CASE("a URDF becomes an MJCF with each link as a body, and its meshes beside it", "[robot]") {
  const worlds::Folder folder;
  write(folder.path() / "robot/arm.urdf", urdf("meshes/arm.obj"));
  write(folder.path() / "robot/meshes/arm.obj", kMesh);
  const fs::path output = folder.path() / "world/scene.xml";
  CHECK(convert({folder.path() / "robot/arm.urdf", {}, output}).empty());
  fs::remove_all(folder.path() / "robot");

  const auto model = load_model(output);
  CHECK(fs::exists(folder.path() / "world/scene/arm.obj"));
  CHECK(model->nmesh == 1);
  const int tool = id(*model, mjOBJ_BODY, "tool");
  REQUIRE(tool >= 0);
  CHECK(model->body_parentid[tool] == id(*model, mjOBJ_BODY, "arm"));
  CHECK(model->body_pos[3 * tool + 2] == 0.5);
  const int shoulder = id(*model, mjOBJ_JOINT, "shoulder");
  REQUIRE(shoulder >= 0);
  CHECK(model->jnt_range[2 * shoulder] == -1);
  CHECK(model->jnt_range[2 * shoulder + 1] == 2);
}

TEST_CASE("a URDF's mesh is found where ROS and MuJoCo would look for it", "[robot]") {
  const worlds::Folder folder;
  const fs::path model = folder.path() / "arm_description/urdf/arm.urdf";
  const auto reads = [&](const std::string& mesh, const std::string& place,
                         const std::string& extension = "") {
    fs::remove_all(folder.path() / "arm_description");
    write(model, urdf(mesh, extension));
    write(folder.path() / place, kMesh);
    CHECK(load_robot(model)->nmesh == 1);
  };
  reads("package://arm_description/meshes/arm.obj", "arm_description/meshes/arm.obj");
  reads("../meshes/arm.obj", "arm_description/meshes/arm.obj");
  reads("file://" + (folder.path() / "elsewhere/arm.obj").string(), "elsewhere/arm.obj");
  reads("package://other/arm.obj", "arm_description/urdf/stl/arm.obj",
        "<mujoco><compiler meshdir='stl'/></mujoco>");
}

TEST_CASE("a URDF's mesh that is missing is named with its line and where it was looked for",
          "[robot]") {
  const worlds::Folder folder;
  write(folder.path() / "arm.urdf", urdf("package://arm_description/arm.obj"));
  CHECK_THROWS_WITH(
      load_robot(folder.path() / "arm.urdf"),
      Catch::Contains("arm.urdf:5: there is no mesh 'package://arm_description/arm.obj'") &&
          Catch::Contains((folder.path() / "arm_description/arm.obj").string()));
}

TEST_CASE("two meshes of one name in a URDF are refused", "[robot]") {
  const worlds::Folder folder;
  std::string text = urdf("a/arm.obj");
  const std::string second =
      "<collision><geometry><mesh filename='b/arm.obj'/></geometry></collision>";
  text.insert(text.find("<inertial>"), second);
  write(folder.path() / "arm.urdf", text);
  write(folder.path() / "a/arm.obj", kMesh);
  write(folder.path() / "b/arm.obj", kMesh);
  CHECK_THROWS_WITH(
      load_robot(folder.path() / "arm.urdf"),
      Catch::Contains("arm.urdf:6: ") && Catch::Contains("b/arm.obj' is called like"));
}

TEST_CASE("an MJCF becomes one file: includes resolved, files copied, no keyframes", "[robot]") {
  const worlds::Folder folder;
  write(folder.path() / "robot/arm.xml", R"(
    <mujoco>
      <compiler meshdir="meshes" texturedir="pictures"/>
      <include file="defaults.xml"/>
      <asset>
        <mesh file="arm.obj"/>
        <mesh name="other" file="more/arm.obj" scale="2 2 2"/>
      </asset>
      <worldbody>
        <body name="arm"><joint class="stiff" name="j"/><geom type="mesh" mesh="arm"/>
        <geom type="mesh" mesh="other"/></body>
      </worldbody>
      <keyframe><key name="home" qpos="0.5"/></keyframe>
    </mujoco>)");
  write(
      folder.path() / "robot/defaults.xml",
      "<mujoco><default><default class='stiff'><joint armature='3'/></default></default></mujoco>");
  write(folder.path() / "robot/meshes/arm.obj", kMesh);
  write(folder.path() / "robot/meshes/more/arm.obj", kMesh);
  const fs::path output = folder.path() / "world/arm.xml";
  const auto remarks = convert({folder.path() / "robot/arm.xml", {}, output});
  REQUIRE(remarks.size() == 1);
  CHECK_THAT(remarks[0], Catch::Contains("name=\"home\"") && Catch::Contains("qpos=\"0.5\""));
  fs::remove_all(folder.path() / "robot");

  const auto model = load_model(output);
  CHECK(model->nmesh == 2);
  CHECK(model->nkey == 0);
  CHECK(model->dof_armature[0] == 3);
  CHECK(fs::exists(folder.path() / "world/arm/arm.obj"));
  CHECK(fs::exists(folder.path() / "world/arm/arm_2.obj"));
  // converted where it stands, it stays what it is
  const std::string before = text_in(output);
  convert({output, {}, output});
  CHECK(text_in(output) == before);
}

TEST_CASE("what is mounted becomes a part of the body", "[robot]") {
  const worlds::Folder folder(worlds::kPendulum);
  folder.write("arm.xml",
               "<mujoco><worldbody><body name='a'><body name='b'><joint/><geom size='1'/></body>"
               "</body></worldbody></mujoco>");
  folder.write("tool.xml", "<mujoco><!-- a tool --><site name='tip' pos='0 0 1'/></mujoco>");
  const fs::path output = folder.path() / "out/arm.xml";
  convert({folder.path() / "arm.xml", {{"b", folder.path() / "tool.xml"}}, output});
  const auto model = load_model(output);
  const int tip = id(*model, mjOBJ_SITE, "tip");
  REQUIRE(tip >= 0);
  CHECK(model->site_bodyid[tip] == id(*model, mjOBJ_BODY, "b"));
  CHECK_THROWS_WITH(
      convert({folder.path() / "arm.xml", {{"c", folder.path() / "tool.xml"}}, output}),
      Catch::Contains("no body 'c'") && Catch::Contains("are: 'a', 'b'"));
}

TEST_CASE("what is not a model is an error that names the file", "[robot]") {
  const worlds::Folder folder;
  folder.write("page.xml", "<html/>");
  CHECK_THROWS_WITH(load_robot(folder.path() / "page.xml"),
                    Catch::Contains("page.xml' is a <html>") && Catch::Contains("<robot>"));
  CHECK_THROWS_WITH(load_robot(folder.path() / "absent.urdf"), Catch::Contains("absent.urdf"));
  folder.write("broken.urdf", "<robot><link");
  CHECK_THROWS_WITH(load_robot(folder.path() / "broken.urdf"), Catch::Contains("broken.urdf"));
}

TEST_CASE("what MuJoCo refuses in a URDF has the name of the file and the line there", "[robot]") {
  const worlds::Folder folder;
  folder.write("arm.urdf", R"(<robot
  name="arm">
  <!-- a comment
       of two lines -->
  <link name="base">
    <visual>
      <geometry/>
    </visual>
  </link>

  <link name="arm">
    <collision><geometry><box
      size="1 1"/></geometry></collision>
  </link>
</robot>)");
  CHECK_THROWS_WITH(load_robot(folder.path() / "arm.urdf"),
                    Catch::Contains("'" + (folder.path() / "arm.urdf").string() + "'") &&
                        Catch::Contains("line 12"));
}

TEST_CASE("a joint of an unknown type is refused with its line and the types that there are",
          "[robot]") {
  const worlds::Folder folder;
  folder.write("arm.urdf",
               "<robot><link name='a'/><link name='b'/>\n<joint name='j' type='hinge'>"
               "<parent link='a'/><child link='b'/></joint></robot>");
  CHECK_THROWS_WITH(load_robot(folder.path() / "arm.urdf"),
                    Catch::Contains("arm.urdf:2: joint 'j' has the type 'hinge'") &&
                        Catch::Contains("'revolute', 'continuous'"));
}
