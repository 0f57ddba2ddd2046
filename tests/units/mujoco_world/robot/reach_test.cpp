#include "units/mujoco_world/robot/reach.h"

#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/model.h"

using mujoco_world::Pose;
using mujoco_world::Reach;
using mujoco_world::Vector;
using mujoco_world::World;

namespace {

const std::string kApproach = STRIDE_SOURCE_DIR "/scenarios/nfc_approach/world";

std::size_t site_index(const World& world, const std::string& name) {
  const auto& sites = world.catalogue().sites;
  std::size_t i = 0;
  while (sites.at(i).name != name) ++i;
  return i;
}

/// A slide that carries a coil down a shaft, against gravity.
std::string lift(const std::string& actuator, const std::string& range = "-1 1") {
  return R"(
    <mujoco>
      <compiler angle="radian" autolimits="true"/>
      <worldbody>
        <site name="tag_coil" pos="0 0 0.5"/>
        <body pos="0 0 1">
          <joint name="lift" type="slide" axis="0 0 1" range=")" +
         range + R"("/>
          <geom type="sphere" size="0.05" mass="2" pos="0 0 0.2"/>
          <site name="reader_coil" quat="0 1 0 0"/>
        </body>
      </worldbody>
      <actuator>)" +
         actuator + R"(</actuator>
    </mujoco>)";
}

}  // namespace

TEST_CASE("a world that is given the commands settles where they were found for", "[robot]") {
  const std::vector<double> distances{0.3, 0.12, 0.05, 0.01};
  const auto poses = Reach(kApproach, "reader_coil", "tag_coil").solve(distances);
  REQUIRE(poses.size() == distances.size());
  World world(kApproach);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (std::size_t i = 0; i < poses[k].commands.size(); ++i) {
      world.set_input(i, poses[k].commands[i]);
    }
    world.advance(world.now() + stride::duration_from_seconds(4));
    const Vector reader = world.site_position(site_index(world, "reader_coil"));
    const Vector tag = world.site_position(site_index(world, "tag_coil"));
    INFO(distances[k]);
    // to what the drives' ripple of 0.5 mrad makes of it
    CHECK(reader[0] == Approx(tag[0]).margin(5e-4));
    CHECK(reader[1] == Approx(tag[1]).margin(5e-4));
    CHECK(reader[2] - tag[2] == Approx(distances[k]).margin(5e-4));
    CHECK(world.site_axis(site_index(world, "reader_coil"))[2] < -0.99999);
    CHECK(poses[k].contacts.empty());
    CHECK(poses[k].overload.empty());
  }
}

TEST_CASE("the same question has the same answer", "[robot]") {
  const auto answer = [] { return Reach(kApproach, "reader_coil", "tag_coil").solve({0.2, 0.1}); };
  const auto first = answer(), second = answer();
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].positions == second[i].positions);
    CHECK(first[i].commands == second[i].commands);
  }
}

TEST_CASE("a command is the pose and what gravity bends the drive", "[robot]") {
  const worlds::Folder folder(lift("<position joint='lift' kp='100'/>"));
  const Pose pose = Reach(folder.path(), "reader_coil", "tag_coil").solve({0.2}).at(0);
  CHECK(pose.positions.at(0) == Approx(-0.3).margin(1e-5));
  CHECK(pose.commands.at(0) == Approx(-0.3 + 2 * 9.81 / 100).margin(1e-5));
}

TEST_CASE("a gear that turns the drive round is taken into account", "[robot]") {
  const worlds::Folder folder(
      lift("<position joint='lift' kp='100' gear='-1' ctrlrange='-0.1 0.4'/>"));
  const auto at = [&](double distance) {
    return Reach(folder.path(), "reader_coil", "tag_coil").solve({distance}).at(0);
  };
  CHECK(at(0.2).positions.at(0) == Approx(-0.3).margin(1e-5));
  CHECK(at(0.2).commands.at(0) == Approx(0.3 - 2 * 9.81 / 100).margin(1e-5));
  CHECK_THROWS_WITH(at(0.05), Catch::Contains("out of reach"));  // -0.45 m
}

TEST_CASE("contacts and weak drives are reported", "[robot]") {
  const worlds::Folder weak(lift("<position joint='lift' kp='100' forcerange='-19 19'/>"));
  const Pose hanging = Reach(weak.path(), "reader_coil", "tag_coil").solve({0.2}).at(0);
  CHECK(hanging.overload == std::vector<std::string>{"lift"});
  CHECK(hanging.contacts.empty());

  std::string text = lift("<position joint='lift' kp='100'/>");
  text.insert(text.find("<site name=\"tag_coil\""),
              "<geom name='shelf' type='box' pos='0 0 0.9' size='0.1 0.1 0.01'/>");
  const worlds::Folder shelf(text);
  const Pose touching = Reach(shelf.path(), "reader_coil", "tag_coil").solve({0.2}).at(0);
  CHECK(touching.contacts == std::vector<std::string>{"'shelf' and 'unnamed_1'"});
}

TEST_CASE("an unreachable pose is an error with the distance that remains", "[robot]") {
  const worlds::Folder folder(lift("<position joint='lift' kp='100'/>", "-0.2 0.2"));
  Reach reach(folder.path(), "reader_coil", "tag_coil");
  CHECK_THROWS_WITH(reach.solve({0.5, 0.1}),
                    Catch::Contains("distance of 0.100000 m") && Catch::Contains("by 0.200000 m"));
}

TEST_CASE("requirements of reach that are missing are errors", "[robot]") {
  const worlds::Folder folder(lift("<motor joint='lift'/>"));
  CHECK_THROWS_WITH(
      Reach(folder.path(), "coil", "tag_coil"),
      Catch::Contains("no site 'coil'") && Catch::Contains("'tag_coil', 'reader_coil'"));
  CHECK_THROWS_WITH(Reach(folder.path(), "reader_coil", "tag_coil"),
                    Catch::Contains("no joint has a position servo"));
}
