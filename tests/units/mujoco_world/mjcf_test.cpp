#include "units/mujoco_world/mjcf.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/hooks.h"

using mujoco_world::find_scene;
using mujoco_world::load_model;

TEST_CASE("the scene is scene.xml or the only .xml", "[mujoco_world]") {
  const worlds::Folder folder;
  CHECK_THROWS_WITH(find_scene(folder.path() / "missing"), Catch::Contains("missing"));
  CHECK_THROWS_WITH(find_scene(folder.path()), Catch::Contains("no MJCF"));
  folder.write("arm.urdf", "");
  CHECK_THROWS_WITH(find_scene(folder.path()),
                    Catch::Contains("no MJCF") && Catch::Contains("stride-robot convert"));
  folder.write("readme.txt", "");
  folder.write("arm.xml", "");
  CHECK(find_scene(folder.path()) == folder.path() / "arm.xml");
  folder.write("table.xml", "");
  CHECK_THROWS_WITH(find_scene(folder.path()), Catch::Contains("several"));
  folder.write("scene.xml", "");
  CHECK(find_scene(folder.path()) == folder.path() / "scene.xml");
}

TEST_CASE("a broken MJCF is an error with the file and MuJoCo's message", "[mujoco_world]") {
  const worlds::Folder folder;
  const auto fails_with = [&](const std::string& mjcf, const std::string& message) {
    folder.write("scene.xml", mjcf);
    CHECK_THROWS_WITH(
        load_model(folder.path() / "scene.xml"),
        Catch::Contains((folder.path() / "scene.xml").string()) && Catch::Contains(message));
  };
  fails_with("<mujoco><worldbody>", "XML");
  fails_with("<mujoco><wurldbody/></mujoco>", "wurldbody");
  fails_with("<mujoco><worldbody><body><joint/></body></worldbody></mujoco>", "mass");
  fails_with("<mujoco><actuator><motor joint='elbow'/></actuator></mujoco>", "elbow");
  CHECK_THROWS_WITH(load_model(folder.path() / "other.xml"), Catch::Contains("other.xml"));
}

TEST_CASE("a file that is missing is named", "[mujoco_world]") {
  const worlds::Folder folder;
  const auto misses = [&](const std::string& mjcf, const std::string& file) {
    folder.write("scene.xml", "<mujoco>" + mjcf + "</mujoco>");
    CHECK_THROWS_WITH(load_model(folder.path() / "scene.xml"), Catch::Contains(file));
  };
  misses("<include file='parts/arm.xml'/>", "parts/arm.xml");
  misses("<compiler meshdir='meshes'/><asset><mesh name='a' file='arm.stl'/></asset>",
         "meshes/arm.stl");
}

TEST_CASE("a required site that a world lacks is an error that lists its sites", "[mujoco_world]") {
  const auto with = [](const std::string& required) {
    return "<mujoco><custom><text name='required_sites' data='" + required +
           "'/></custom><worldbody><site name='tip'/><site/><site "
           "name='base'/></worldbody></mujoco>";
  };
  const worlds::Folder folder(with("base tip"));
  CHECK_NOTHROW(load_model(folder.path() / "scene.xml"));
  folder.write("scene.xml", with("tip  reader_coil"));
  CHECK_THROWS_WITH(load_model(folder.path() / "scene.xml"),
                    Catch::Contains("scene.xml' has no site 'reader_coil'") &&
                        Catch::Contains("its named sites are: 'tip', 'base'"));
  folder.write("scene.xml",
               "<mujoco><custom><text name='required_sites' data='tip'/></custom></mujoco>");
  CHECK_THROWS_WITH(load_model(folder.path() / "scene.xml"), Catch::Contains("are: none"));
}

TEST_CASE("the catalogue lists what can be wired, with units", "[mujoco_world]") {
  const worlds::Folder folder(R"(
    <mujoco>
      <worldbody>
        <body>
          <freejoint name="loose"/>
          <geom size="0.1"/>
          <site/>
          <site name="mark"/>
          <body>
            <joint name="hinge"/>
            <joint type="slide"/>
            <geom size="0.1"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position name="angle" joint="hinge" kp="5"/>
        <velocity name="speed" joint="hinge" kv="2"/>
        <motor name="torque" joint="hinge"/>
        <motor name="geared" joint="hinge" gear="50"/>
        <general joint="hinge" gainprm="3"/>
        <intvelocity name="drive" joint="hinge" kp="5" ctrllimited="true" ctrlrange="-2 3" actrange="-1 1"/>
      </actuator>
      <sensor>
        <jointvel name="rate" joint="hinge"/>
        <force site="mark"/>
        <framequat name="attitude" objtype="site" objname="mark"/>
      </sensor>
    </mujoco>)");
  const auto model = load_model(folder.path() / "scene.xml");
  const auto catalogue = mujoco_world::list(*model);

  std::vector<std::string> found;
  for (const auto& a : catalogue.actuators) found.push_back(a.name + " " + a.unit);
  CHECK(found == std::vector<std::string>{"angle rad", "speed rad/s", "torque N.m", "geared ",
                                          "unnamed_4 ", "drive rad/s"});
  CHECK_FALSE(catalogue.actuators[0].range);
  CHECK(catalogue.actuators[5].range == std::pair(-2.0, 3.0));
  found.clear();
  for (const auto& j : catalogue.joints) found.push_back(j.name + " " + j.unit);
  CHECK(found == std::vector<std::string>{"hinge rad", "unnamed_2 m"});
  CHECK(catalogue.joints[0].position == 7);
  CHECK(catalogue.joints[0].velocity == 6);
  found.clear();
  for (const auto& s : catalogue.sites) found.push_back(s.name);
  CHECK(found == std::vector<std::string>{"mark"});
  found.clear();
  for (const auto& s : catalogue.sensors) {
    found.push_back(s.name + " " + s.unit + " " + std::to_string(s.dimension));
  }
  CHECK(found == std::vector<std::string>{"rate rad/s 1", "unnamed_1 N 3", "attitude  4"});
}

TEST_CASE("what would make runs irreproducible is switched off aloud", "[mujoco_world]") {
  mujoco_world::take_warnings();
  const bool is_mujoco2 = mjVERSION_HEADER < 3000000;
  const std::string flag = is_mujoco2 ? "sensornoise" : "sleep";
  const worlds::Folder folder("<mujoco><option><flag " + flag + "='enable'/></option></mujoco>");
  const auto model = load_model(folder.path() / "scene.xml");
  CHECK((model->opt.enableflags & mujoco_world::api::kIrreproducible) == 0);
  const auto warnings = mujoco_world::take_warnings();
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("scene.xml"));
}

TEST_CASE("an MJCF that is no XML is an error in plain words", "[mujoco_world]") {
  const worlds::Folder folder("<mujoco>\n<worldbody>\n</mujoco>");
  try {
    load_model(folder.path() / "scene.xml");
    FAIL("it was loaded");
  } catch (const std::exception& error) {
    CHECK_THAT(error.what(),
               Catch::Contains("not well-formed XML: look for a mistake in or above") &&
                   !Catch::Contains("XML_ERROR"));
  }
}

TEST_CASE("a lamp that is no geom is an error", "[mujoco_world]") {
  const worlds::Folder folder(R"(<mujoco>
    <custom><text name="lamps" data="lid"/></custom>
    <worldbody><geom name="led" type="sphere" size="0.1"/></worldbody>
  </mujoco>)");
  const std::string file = (folder.path() / "scene.xml").string();
  REQUIRE_THROWS_WITH(load_model(file),
                      "'" + file + "': <text name=\"lamps\"> lists 'lid', which is no geom: " +
                          "expected names of geoms, separated by blanks; those that have a name " +
                          "are: 'led'");
}

TEST_CASE("a field that is at no site is an error", "[mujoco_world]") {
  const worlds::Folder folder(R"(<mujoco>
    <custom><text name="fields" data="coil loop"/></custom>
    <worldbody><site name="coil"/><geom name="loop" type="sphere" size="0.1"/></worldbody>
  </mujoco>)");
  REQUIRE_THROWS_WITH(load_model(folder.path() / "scene.xml"),
                      Catch::Contains("<text name=\"fields\"> lists 'loop', which is no site: ") &&
                          Catch::Contains("those that have a name are: 'coil'"));
}

TEST_CASE("a lamp that is listed twice is an error", "[mujoco_world]") {
  const worlds::Folder folder(R"(<mujoco>
    <custom><text name="lamps" data="led led"/></custom>
    <worldbody><geom name="led" type="sphere" size="0.1"/></worldbody>
  </mujoco>)");
  REQUIRE_THROWS_WITH(load_model(folder.path() / "scene.xml"),
                      Catch::Contains("scene.xml': <text name=\"lamps\"> lists 'led' twice"));
}
