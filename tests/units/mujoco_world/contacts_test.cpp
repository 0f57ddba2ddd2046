#include "units/mujoco_world/contacts.h"

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/error_of.h"
#include "tests/units/mujoco_world/states.h"
#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/model.h"

namespace {

using Catch::Matchers::Contains;
using mujoco_world::World;
using stride::Duration;
using stride::Time;
using stride::tests::at;
using stride::tests::error_of;
using worlds::same_bits;
using worlds::saved;

constexpr std::size_t kFloor = 0, kAny = 1;

/// When the contact with the floor begins and ends in the first second.
std::vector<Time> changes(World& world) {
  std::vector<Time> times;
  while (world.now() < at(1)) {
    const bool before = world.touches(kFloor);
    const bool stopped = world.advance(at(1), true);
    CHECK(stopped == (world.touches(kFloor) != before));
    if (stopped) times.push_back(world.now());
  }
  return times;
}

std::string refusal(const std::string& tuple) {
  std::string mjcf = worlds::kBounce;
  mjcf.insert(mjcf.find("</custom>"), "<tuple name=\"contact.bad\">" + tuple + "</tuple>");
  const worlds::Folder folder(mjcf);
  return error_of([&] { const World world(folder.path()); });
}

std::string element(const std::string& type, const std::string& name) {
  return "<element objtype=\"" + type + "\" objname=\"" + name + "\"/>";
}

}  // namespace

TEST_CASE("the tuples called contact. are listed", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kBounce);
  const World world(folder.path());
  REQUIRE(world.contacts().size() == 2);
  CHECK(world.contacts()[kFloor].name == "floor");
  CHECK(world.contacts()[kAny].name == "any");
}

TEST_CASE("a way ends at the grid point where a contact begins or ends", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kBounce);
  World world(folder.path());
  const auto times = changes(world);

  // 0.25 m of free fall take 0.2258 s, and the grid has 1 ms
  REQUIRE(times.size() >= 4);
  CHECK(times[0] == at(0.226));
  for (std::size_t i = 1; i < times.size(); ++i) {
    CHECK(times[i] > times[i - 1]);
    CHECK((times[i] - Time{}) % world.timestep() == Duration{});
  }

  SECTION("wherever other steps end") {
    World other(folder.path());
    std::vector<Time> found;
    while (other.now() < at(1)) {
      const Time to = std::min(at(1), other.now() + Duration(3'300'000'000));
      if (other.advance(to, true)) found.push_back(other.now());
    }
    CHECK(found == times);
    CHECK(same_bits(saved(other), saved(world)));
  }
  SECTION("unless it may not, and the motion is the same") {
    World other(folder.path());
    CHECK_FALSE(other.advance(at(1)));
    CHECK(other.now() == at(1));
    CHECK(same_bits(saved(other), saved(world)));
  }
}

TEST_CASE("a contact is part of a state", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kBounce);
  World world(folder.path());
  REQUIRE(world.advance(at(1), true));
  REQUIRE(world.touches(kFloor));
  REQUIRE(world.touches(kAny));
  const auto touching = saved(world);

  World other(folder.path());
  other.restore(touching.data());
  CHECK(other.touches(kFloor));
  CHECK(other.advance(at(1), true));
  CHECK_FALSE(other.touches(kFloor));
  other.restore(touching.data());
  CHECK(other.touches(kFloor));
  other.reset(Time{});
  CHECK_FALSE(other.touches(kFloor));
}

TEST_CASE("a world can begin in contact", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kBounce);
  World world(folder.path());
  auto pose = mujoco_world::default_start(world.model());
  pose.positions[2] = 0.0499;
  world.reset(at(2), pose);
  CHECK(world.touches(kFloor));
}

TEST_CASE("what cannot be in contact is refused", "[mujoco_world]") {
  CHECK_THAT(refusal(element("site", "centre")),
             Contains("contact.bad") && Contains("objtype=\"body\" or objtype=\"geom\""));
  CHECK_THAT(refusal(element("body", "ball") + element("body", "gate") + element("body", "world")),
             Contains("one or two elements"));
  CHECK_THAT(refusal(element("body", "ball") + element("geom", "shell")),
             Contains("does not let them collide"));
  CHECK_THAT(refusal(element("body", "bal")), Contains("bal"));
}
