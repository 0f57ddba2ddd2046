#include "units/mujoco_world/robot/inertia.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/robot/convert.h"

using Catch::Contains;
using mujoco_world::convert;
using mujoco_world::load_model;
using mujoco_world::ModelPointer;
using mujoco_world::take_warnings;

namespace {

const std::string kSound =
    "<inertial><mass value='1'/>"
    "<inertia ixx='0.1' iyy='0.2' izz='0.25' ixy='0' ixz='0' iyz='0'/></inertial>";

std::string inertial(const std::string& mass, const std::string& xx, const std::string& yy,
                     const std::string& zz, const std::string& xy = "0") {
  return "<inertial><mass value='" + mass + "'/><inertia ixx='" + xx + "' iyy='" + yy + "' izz='" +
         zz + "' ixy='" + xy + "' ixz='0' iyz='0'/></inertial>";
}

/// A base, in line 3 a `middle` that a joint of that type moves, and a `tip` on it.
std::string arm(const std::string& middle, const std::string& type = "revolute",
                const std::string& tip_type = "revolute", const std::string& extension = "") {
  const std::string limit = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";
  return "<robot name='arm'>" + extension + "\n<link name='base'/>\n<link name='middle'>" + middle +
         "</link>\n<link name='tip'>" + kSound + "</link>\n<joint name='a' type='" + type +
         "'><parent link='base'/><child link='middle'/>" + limit +
         "</joint>\n<joint name='b' type='" + tip_type +
         "'><parent link='middle'/><child link='tip'/>" + limit + "</joint>\n</robot>";
}

/// The model that the URDF is converted to, with the warnings of that.
class Converted {
 public:
  explicit Converted(const std::string& urdf) {
    const worlds::Folder folder;
    folder.write("arm.urdf", urdf);
    take_warnings();
    convert({folder.path() / "arm.urdf", {}, folder.path() / "out/arm.xml"});
    warnings = take_warnings();
    model = load_model(folder.path() / "out/arm.xml");
  }

  double mass(const char* body) const { return model->body_mass[id(body)]; }
  std::vector<double> inertia(const char* body) const {
    const double* const values = model->body_inertia + 3 * id(body);
    return {values, values + 3};
  }

  std::vector<std::string> warnings;
  ModelPointer model;

 private:
  int id(const char* body) const {
    const int found = mj_name2id(model.get(), mjOBJ_BODY, body);
    REQUIRE(found >= 0);
    return found;
  }
};

void check_is_sound(const Converted& robot) {
  CHECK(robot.mass("tip") == 1);
  CHECK(robot.inertia("tip") == std::vector{0.25, 0.2, 0.1});
}

void check_inertia(const Converted& robot, const std::vector<double>& expected) {
  const auto inertia = robot.inertia("middle");
  for (std::size_t i = 0; i < 3; ++i) CHECK(inertia[i] == Approx(expected[i]).epsilon(1e-4));
}

}  // namespace

TEST_CASE("a moving link without mass becomes a gram, a ball of water", "[robot]") {
  for (const std::string& middle :
       {std::string(), inertial("0", "0", "0", "0"), inertial("1e-20", "0", "0", "0")}) {
    const Converted robot(arm(middle));
    REQUIRE(robot.warnings.size() == 1);
    CHECK_THAT(robot.warnings[0], Contains("arm.urdf:3: link 'middle': the mass of ") &&
                                      Contains(" is replaced by 0.001 kg, and the inertia") &&
                                      Contains("of 0 0 0 0 0 0 kg.m2 is replaced by 1.53934e-08"));
    CHECK(robot.mass("middle") == 0.001);
    check_inertia(robot, {1.53934e-8, 1.53934e-8, 1.53934e-8});
    check_is_sound(robot);
  }
}

TEST_CASE("a mass that is negative is repaired also where nothing moves", "[robot]") {
  for (const char* type : {"revolute", "fixed"}) {
    const Converted robot(arm(inertial("-1", "0.1", "0.1", "0.1"), type));
    REQUIRE(robot.warnings.size() == 1);
    CHECK_THAT(robot.warnings[0], Contains("mass of -1 kg is replaced by 0.001 kg"));
    CHECK(robot.mass("middle") == 0.001);
    check_inertia(robot, {0.1, 0.1, 0.1});
  }
}

TEST_CASE("an inertia that is absent or 0 becomes that of a ball of the link's mass", "[robot]") {
  for (const std::string& middle :
       {inertial("1", "0", "0", "0"), std::string("<inertial><mass value='1'/></inertial>")}) {
    const Converted robot(arm(middle));
    REQUIRE(robot.warnings.size() == 1);
    CHECK_THAT(robot.warnings[0], Contains("arm.urdf:3: link 'middle': the inertia") &&
                                      Contains("by 0.00153934 0.00153934 0.00153934 0 0 0"));
    CHECK(robot.mass("middle") == 1);
    check_inertia(robot, {1.53934e-3, 1.53934e-3, 1.53934e-3});
  }
}

TEST_CASE("only the principal moments that are not above 0 are repaired", "[robot]") {
  for (const char* xx : {"0", "-0.2"}) {
    const Converted robot(arm(inertial("1", xx, "0.1", "0.1")));
    CHECK(robot.warnings.size() == 1);
    check_inertia(robot, {0.1, 0.1, 1.53934e-3});
  }
  // the ball would be far above what the link has
  check_inertia(Converted(arm(inertial("1", "0", "1e-6", "1e-6"))), {1e-6, 1e-6, 1e-6});
}

TEST_CASE("a rod that does not move is what MuJoCo takes", "[robot]") {
  for (const char* mass : {"1", "0"}) {
    const Converted robot(arm(inertial(mass, "0.1", "0.1", "0"), "fixed"));
    const bool is_repaired = mjVERSION_HEADER >= 300;
    CHECK(robot.warnings.size() == (is_repaired ? 1 : 0));
    CHECK((robot.inertia("middle")[2] > 0) == is_repaired);
  }
}

TEST_CASE("an inertia without the triangle inequality becomes the nearest with it", "[robot]") {
  const std::vector<double> repaired{0.4, 0.2, 0.2};
  for (const char* type : {"revolute", "fixed"}) {
    const Converted robot(arm(inertial("1", "0.5", "0.1", "0.1"), type));
    REQUIRE(robot.warnings.size() == 1);
    CHECK_THAT(robot.warnings[0],
               Contains("link 'middle': the inertia (ixx iyy izz ixy ixz iyz)") &&
                   Contains("of 0.5 0.1 0.1 0 0 0 kg.m2 is replaced by 0.39999") &&
                   Contains("exceeds the sum of the others"));
    check_inertia(robot, repaired);
    check_is_sound(robot);
  }
  // the same, turned by 45 degrees
  const Converted turned(arm(inertial("1", "0.3", "0.3", "0.1", "0.2")));
  check_inertia(turned, repaired);
  CHECK_THAT(turned.warnings.at(0), Contains("by 0.3 0.3 0.200003 0.0999967 0 0 kg.m2"));
}

TEST_CASE("links that MuJoCo takes keep what they have, without a warning", "[robot]") {
  const auto keeps = [](const std::string& urdf, double mass) {
    const Converted robot(urdf);
    CHECK(robot.warnings.empty());
    CHECK(robot.mass("middle") == Approx(mass));
    check_is_sound(robot);
  };
  keeps(arm(inertial("2", "0.1", "0.2", "0.3")), 2);     // a thin plate
  keeps(arm("", "fixed"), 0);                            // does not move
  keeps(arm(inertial("0", "0", "0", "0"), "fixed"), 0);  // nor does this
  keeps(arm("", "revolute", "fixed"), 0);                // carries the tip
  keeps(arm("<collision><geometry><box size='0.1 0.1 0.1'/></geometry></collision>"), 1);
}

TEST_CASE("a URDF that controls MuJoCo's own repairs is left to them", "[robot]") {
  const Converted robot(arm(inertial("1", "0.5", "0.1", "0.1"), "revolute", "revolute",
                            "<mujoco><compiler balanceinertia='true'/></mujoco>"));
  CHECK(robot.warnings.empty());
  check_inertia(robot, {0.7 / 3, 0.7 / 3, 0.7 / 3});
}

TEST_CASE("a mass that is not a number is left to MuJoCo's error, with its line", "[robot]") {
  CHECK_THROWS_WITH(Converted(arm(inertial("heavy", "0", "0", "0"))),
                    Contains("arm.urdf") && Contains("line 3"));
}
