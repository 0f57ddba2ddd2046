#include "units/mujoco_world/start_pose.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/model.h"

namespace {

using Catch::Matchers::Contains;
using mujoco_world::StartPose;
using mujoco_world::Vector;
using mujoco_world::World;
using stride::Time;
using stride::tests::error_of;

enum Position : std::size_t { kBallX = 0, kBallZ = 2, kBallW = 3, kGate = 7, kHeadW = 8 };

class Start {
 public:
  Start() : pose_(mujoco_world::default_start(world.model())) {}

  Start& keyframe(const std::string& name) { return pose_.keyframe = name, *this; }
  Start& at(std::size_t position, double value) {
    return pose_.positions.at(position) = value, *this;
  }
  void begin() { world.reset(Time{}, pose_); }
  std::string error() {
    return error_of([&] { begin(); });
  }

  worlds::Folder folder{worlds::kBounce};
  World world{folder.path()};

 private:
  StartPose pose_;
};

}  // namespace

TEST_CASE("each number of a start pose has a name and a unit", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kBounce);
  const World world(folder.path());
  std::string text;
  for (const auto& position : mujoco_world::list_start_positions(world.model())) {
    text += position.parameter + " [" + position.unit + "]\n";
  }
  CHECK(text ==
        "body.ball.start.position.x [m]\nbody.ball.start.position.y [m]\n"
        "body.ball.start.position.z [m]\nbody.ball.start.orientation.w []\n"
        "body.ball.start.orientation.x []\nbody.ball.start.orientation.y []\n"
        "body.ball.start.orientation.z []\njoint.gate.start [rad]\njoint.head.start.w []\n"
        "joint.head.start.x []\njoint.head.start.y []\njoint.head.start.z []\n");
}

TEST_CASE("a world begins in its keyframe called start, or as the model is", "[mujoco_world]") {
  const worlds::Folder pendulum(worlds::kPendulum);
  CHECK(World(pendulum.path()).joint_position(0) == 2);
  const Start start;
  CHECK(start.world.site_position(0)[2] == 0.3);
}

TEST_CASE("a keyframe is chosen by its name", "[mujoco_world]") {
  Start start;
  start.keyframe("high").begin();
  CHECK(start.world.site_position(0)[2] == 1);

  start.keyframe("hihg");
  CHECK_THAT(start.error(), Contains("no keyframe 'hihg'") && Contains("'high', 'open'"));
}

TEST_CASE("joints begin where they are put, over the keyframe", "[mujoco_world]") {
  Start start;
  start.keyframe("high").at(kGate, 0.25).at(kBallX, 0.1).begin();
  CHECK(start.world.joint_position(0) == 0.25);
  CHECK(start.world.site_position(0) == Vector{0.1, 0, 1});

  SECTION("and at the next start, too") {
    start.at(kGate, 0.5).begin();
    CHECK(start.world.joint_position(0) == 0.5);
    CHECK(start.world.site_position(0) == Vector{0.1, 0, 1});
  }
  SECTION("which is no part of a state") {
    std::vector<double> block(start.world.state_size());
    start.world.save(block.data());
    start.keyframe("").at(kGate, -0.5).begin();
    start.world.restore(block.data());
    CHECK(start.world.joint_position(0) == 0.25);
    CHECK(start.world.site_position(0) == Vector{0.1, 0, 1});
  }
}

TEST_CASE("an orientation is a whole quaternion of any length", "[mujoco_world]") {
  Start start;
  start.at(kHeadW, 3).at(kHeadW + 1, 0).at(kHeadW + 2, 0);
  CHECK_THAT(start.error(), Contains("joint.head.start.{w,x,y,z} is set in part"));
  start.at(kHeadW + 3, 3).begin();
  const Vector nose = start.world.site_position(1);
  CHECK(nose[0] == Approx(1));
  CHECK(nose[1] == Approx(0.1));

  for (std::size_t i = 0; i < 4; ++i) start.at(kBallW + i, 0);
  CHECK_THAT(start.error(), Contains("body.ball.start.orientation.{w,x,y,z} is zero"));
}

TEST_CASE("a position is finite", "[mujoco_world]") {
  Start start;
  start.at(kGate, std::numeric_limits<double>::infinity());
  CHECK_THAT(start.error(), Contains("joint.gate.start is infinite"));
}

TEST_CASE("a start inside of something, or beyond a joint's range, is a flaw", "[mujoco_world]") {
  Start start;
  CHECK(start.world.flaws().empty());

  start.at(kBallZ, 0.0495).begin();  // as deep as it rests
  CHECK(start.world.flaws().empty());

  start.at(kBallZ, 0.047).at(kGate, 1.5).begin();
  const auto flaws = start.world.flaws();
  REQUIRE(flaws.size() == 2);
  CHECK_THAT(flaws[0], Contains("'world' (geom 'floor')") && Contains("'ball' (geom 'shell')") &&
                           Contains(" 3 mm"));
  CHECK_THAT(flaws[1], Contains("'gate' at 1.5") && Contains("from -1 to 1"));

  start.at(kBallZ, 1).at(kGate, 0).begin();
  CHECK(start.world.flaws().empty());
}
