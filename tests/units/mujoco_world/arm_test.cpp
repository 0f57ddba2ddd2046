// The NFC scenario's arm: what the reader's waypoints rely on.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "units/mujoco_world/model.h"
#include "units/reader/motion.h"

namespace {

using mujoco_world::Vector;
using mujoco_world::World;

std::size_t site(const World& world, const std::string& name) {
  const auto& sites = world.catalogue().sites;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites[i].name == name) return i;
  }
  throw std::runtime_error("no site " + name);
}

double reading(const World& world, const std::string& name) {
  const auto& sensors = world.catalogue().sensors;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].name == name) return world.sensor(i);
  }
  throw std::runtime_error("no sensor " + name);
}

struct Coils {
  double distance;  // [m]
  double offset;    // [m], off the tag coil's axis
  double alignment;
};

Coils coils(const World& world) {
  const Vector reader = world.site_position(site(world, "reader_coil"));
  const Vector tag = world.site_position(site(world, "tag_coil"));
  const Vector normal = world.site_axis(site(world, "reader_coil"));
  const Vector tag_normal = world.site_axis(site(world, "tag_coil"));
  const Vector gap{reader[0] - tag[0], reader[1] - tag[1], reader[2] - tag[2]};
  const auto dot = [](const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  return {std::sqrt(dot(gap, gap)), std::hypot(gap[0], gap[1]), dot(normal, tag_normal)};
}

void command(World& world, const std::array<double, 6>& pose) {
  for (std::size_t i = 0; i < pose.size(); ++i) world.set_input(i, pose[i]);
}

/// Commands the way from one pose to another as the reader does, with minimum jerk, and stays there
/// for as long again. Calls visit() at each grid point.
template <class Visit>
void approach(World& world, const std::array<double, 6>& from, const std::array<double, 6>& to,
              double seconds, Visit visit) {
  const std::vector<reader::Waypoint> way = {
      {world.now(), {from.begin(), from.end()}},
      {world.now() + stride::duration_from_seconds(seconds), {to.begin(), to.end()}}};
  const stride::Time end = way[1].at + (way[1].at - way[0].at);
  while (world.now() < end) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      world.set_input(i, reader::position(way, i, world.now()));
    }
    world.advance(world.now() + world.timestep());
    visit();
  }
}

constexpr const char* kArm = STRIDE_SOURCE_DIR "/scenarios/nfc_approach/world";
constexpr std::array<double, 6> kFar{0.2915, 0.3721, 0.8501, 1.9170, 0, 0};    // 0.40 m
constexpr std::array<double, 6> kClose{0.2915, 0.5116, 1.6946, 0.9330, 0, 0};  // 0.01 m

}  // namespace

TEST_CASE("the sensor on the table has an LED", "[mujoco_world]") {
  const World world(kArm);
  REQUIRE(world.catalogue().lamps.size() == 1);
  CHECK(world.catalogue().lamps[0].name == "led");
}

TEST_CASE("the arm starts at rest, the coils 0.40 m apart on one axis", "[mujoco_world][arm]") {
  World world(kArm);
  std::string names;
  for (const auto& actuator : world.catalogue().actuators) {
    names += actuator.name + " " + actuator.unit + ", ";
  }
  CHECK(names == "base rad, shoulder rad, elbow rad, wrist_1 rad, wrist_2 rad, wrist_3 rad, ");
  for (std::size_t i = 0; i < kFar.size(); ++i) CHECK(world.input(i) == kFar[i]);

  for (const double seconds : {0.0, 0.01, 0.1, 1.0}) {
    world.advance(stride::time_from_seconds(seconds));
    const Coils seen = coils(world);
    CHECK(seen.distance == Approx(0.4).margin(0.5e-3));
    CHECK(seen.offset < 0.5e-3);
    CHECK(seen.alignment < -0.99999);
  }
}

TEST_CASE("a pose settles within half a millimetre, without knocking on anything",
          "[mujoco_world][arm]") {
  World world(kArm);
  double closest = 1;
  double hardest = 0;  // [N]
  approach(world, kFar, kClose, 1, [&] {
    closest = std::min(closest, coils(world).distance);
    hardest = std::max(hardest, reading(world, "reader_contact"));
  });
  CHECK(coils(world).distance == Approx(0.01).margin(0.5e-3));
  CHECK(coils(world).offset < 0.5e-3);
  CHECK(closest > 0.009);
  CHECK(hardest == 0);

  command(world, kFar);
  world.advance(stride::time_from_seconds(5));
  CHECK(coils(world).distance == Approx(0.4).margin(0.5e-3));
}

TEST_CASE("the sensor stops the arm, and the contact is felt", "[mujoco_world][arm]") {
  World world(kArm);
  auto pose = kClose;
  pose[1] += 0.1;  // the shoulder aims 5 cm below
  command(world, pose);
  world.advance(stride::time_from_seconds(3));
  const double height = world.site_position(site(world, "reader_coil"))[2];
  const double tag_height = world.site_position(site(world, "tag_coil"))[2];
  CHECK(height > tag_height - 0.01);
  CHECK(height < tag_height + 0.008);
  CHECK(reading(world, "reader_contact") > 100);
}

TEST_CASE("the table stops the arm with the force that the shoulder's drive has left",
          "[mujoco_world][arm]") {
  World world(kArm);
  auto pose = kClose;
  pose[0] = -0.3;  // beside the sensor
  command(world, pose);
  world.advance(stride::time_from_seconds(3));
  CHECK(reading(world, "reader_contact") == 0);
  CHECK(reading(world, "table_contact") == 0);

  pose[1] += 0.1;
  command(world, pose);
  world.advance(stride::time_from_seconds(6));
  const Vector coil = world.site_position(site(world, "reader_coil"));
  CHECK(coil[2] > -0.001);  // 1 mm into the housing
  CHECK(coil[2] < 0.002);
  const double force = reading(world, "reader_contact");
  CHECK(reading(world, "table_contact") == Approx(force));
  // 150 N.m of the drive and 34 N.m of the arm's weight at a lever of 0.52 m
  CHECK(force > 250);
  CHECK(force < 400);

  command(world, kFar);
  world.advance(stride::time_from_seconds(8));
  CHECK(reading(world, "table_contact") == 0);
}
