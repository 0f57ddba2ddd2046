// A world that may rest beside the same one that may not.
#include "units/mujoco_world/rest.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/states.h"
#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/model.h"

using namespace std::chrono_literals;
using mujoco_world::Motion;
using mujoco_world::RestDetector;
using mujoco_world::RestLimits;
using mujoco_world::RestSettings;
using mujoco_world::World;
using stride::Duration;
using stride::Time;

namespace {

constexpr double kTolerance = 1e-4;

RestSettings settings(const World& world, double tolerance = kTolerance,
                      Duration longest = Duration::max()) {
  RestSettings settings;
  const auto& catalogue = world.catalogue();
  auto& t = settings.tolerances;
  t.joint_positions.assign(catalogue.joints.size(), tolerance);
  t.joint_velocities.assign(catalogue.joints.size(), 10 * tolerance);
  t.site_positions.assign(catalogue.sites.size(), {tolerance, tolerance, tolerance});
  t.site_axes = t.site_positions;
  t.sensors.assign(world.sensor_numbers(), 10 * tolerance);
  settings.longest = longest;
  return settings;
}

/// The same world twice: one that rests, and one that does not.
struct Pair {
  explicit Pair(const std::string& mjcf, double tolerance = kTolerance,
                Duration longest = Duration::max())
      : folder(mjcf), resting(folder.path()), plain(folder.path()) {
    resting.allow_rest(settings(resting, tolerance, longest));
    resting.reset(Time{});
  }
  void set_input(double value) {
    resting.set_input(0, value);
    plain.set_input(0, value);
  }
  void advance(Time to) {
    resting.advance(to);
    plain.advance(to);
  }
  /// The greatest distance of what is seen of the two.
  double apart() const {
    double apart = 0;
    const auto& catalogue = plain.catalogue();
    for (std::size_t i = 0; i < catalogue.joints.size(); ++i) {
      apart = std::max(apart, std::abs(resting.joint_position(i) - plain.joint_position(i)));
    }
    for (std::size_t i = 0; i < catalogue.sites.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        apart = std::max({apart, std::abs(resting.site_position(i)[k] - plain.site_position(i)[k]),
                          std::abs(resting.site_axis(i)[k] - plain.site_axis(i)[k])});
      }
    }
    return apart;
  }
  bool rests() const { return resting.rests_until() > resting.now(); }

  worlds::Folder folder;
  World resting, plain;
};

using worlds::same_bits;
using worlds::saved;

/// A servo with a time constant of `damping` / 100 s; gravity pulls at it.
std::string servo(double damping, double stiffness = 100) {
  return R"(
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body>
      <joint name="lever" axis="0 1 0" damping=")" +
         std::to_string(damping) + R"("/>
      <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="0.5"/>
      <site name="end" pos="0.5 0 0"/>
    </body>
  </worldbody>
  <actuator><position name="lever" joint="lever" kp=")" +
         std::to_string(stiffness) + R"("/></actuator>
  <sensor><jointpos joint="lever"/></sensor>
</mujoco>)";
}

struct Seen {
  double speed = 0;
  double acceleration = 0;
  double sensor = 0;
  std::uint64_t contacts = 0;
  double activation = 0;
};

/// With a window of ten steps.
struct Observer {
  RestDetector detector{RestLimits{1e-3, 1e-1, 10ms}, 1ms, 1, 1};
  bool see(Seen seen) {
    return detector.observe(
        {&seen.speed, &seen.acceleration, &seen.sensor, seen.activation, seen.contacts});
  }
  /// How many steps it takes until it is at rest, at most `most`.
  template <class Course>
  int steps_to_rest(Course course, int most = 1000) {
    for (int i = 1; i <= most; ++i) {
      if (see(course(i))) return i;
    }
    return most + 1;
  }
};

}  // namespace

TEST_CASE("what does not move is at rest after a window") {
  Observer observer;
  CHECK(observer.steps_to_rest([](int) { return Seen{}; }) == 10);
  CHECK(observer.detector.half_window() == Approx(5e-3));
}

TEST_CASE("the bounds are those of the second half") {
  Observer observer;
  CHECK(observer.steps_to_rest([](int i) { return Seen{1e-3 / i, -1e-1 / i, 1.0 / i}; }) == 10);
  CHECK(observer.detector.speed(0) == 1e-3 / 6);
  CHECK(observer.detector.acceleration(0) == 1e-1 / 6);
  CHECK(observer.detector.sensor_low(0) == 1.0 / 10);
  CHECK(observer.detector.sensor_high(0) == 1.0 / 6);
}

TEST_CASE("a speed, an acceleration, an activation or a contact starts the window anew") {
  const auto disturbed_at_7 = [](const Seen& disturbance) {
    Observer observer;
    return observer.steps_to_rest([&](int i) { return i == 7 ? disturbance : Seen{}; });
  };
  CHECK(disturbed_at_7({}) == 10);
  CHECK(disturbed_at_7({1.1e-3, 0}) == 17);
  CHECK(disturbed_at_7({0, -1.1e-1}) == 17);
  CHECK(disturbed_at_7({std::numeric_limits<double>::quiet_NaN(), 0}) == 17);
  CHECK(disturbed_at_7({0, 0, 0, 0, 1.1e-3}) == 17);
  CHECK(disturbed_at_7({0, 0, 0, 1, 0}) == 18);  // what touches comes and goes
}

TEST_CASE("a speed that grows is not rest, a creep is") {
  CHECK(Observer().steps_to_rest([](int i) { return Seen{1e-8 * std::exp(0.01 * i)}; }) == 1001);
  CHECK(Observer().steps_to_rest([](int) { return Seen{1e-4}; }) == 10);
  CHECK(Observer().steps_to_rest([](int i) { return Seen{1e-4 * std::exp(-0.01 * i)}; }) == 10);
  CHECK(Observer().steps_to_rest([](int i) { return Seen{1e-12 * i}; }) == 10);  // noise
}

TEST_CASE("after a rest half a window is enough") {
  Observer observer;
  observer.steps_to_rest([](int) { return Seen{}; });
  CHECK(observer.steps_to_rest([](int) { return Seen{}; }) == 5);
}

TEST_CASE("a detector goes on from its state") {
  Observer observer;
  observer.steps_to_rest([](int i) { return Seen{1e-4 / i, 0, 0, 3}; }, 7);
  std::vector<double> block(observer.detector.state_size());
  observer.detector.save(block.data());
  Observer other;
  other.detector.restore(block.data());
  CHECK(other.steps_to_rest([](int) {
    return Seen{0, 0, 0, 3};
  }) == observer.steps_to_rest([](int) {
    return Seen{0, 0, 0, 3};
  }));
}

TEST_CASE("limits are positive") {
  CHECK_THROWS_WITH(RestDetector({0, 1, 1ms}, 1ms, 1, 0), Catch::Contains("rest.speed"));
  CHECK_THROWS_WITH(RestDetector({1, -1, 1ms}, 1ms, 1, 0), Catch::Contains("rest.acceleration"));
  CHECK_THROWS_WITH(RestDetector({1, 1, 0ms}, 1ms, 1, 0), Catch::Contains("rest.window"));
}

TEST_CASE("a servo that has settled rests, within the tolerance of the one that goes on",
          "[mujoco_world]") {
  for (const double damping : {2.0, 5.0, 20.0, 50.0}) {  // from a ringing to 0.5 s
    CAPTURE(damping);
    Pair pair(servo(damping));
    int resting = 0;
    for (int i = 1; i <= 400; ++i) {
      pair.set_input(i <= 200 ? 0.5 : -0.25);
      pair.advance(Time(i * 50ms));
      REQUIRE(pair.apart() < kTolerance);
      if (pair.rests()) ++resting;
    }
    CHECK(resting > 100);
  }
}

TEST_CASE("a box that falls to the floor comes to rest there", "[mujoco_world]") {
  Pair pair(R"(
<mujoco>
  <option timestep="0.002"/>
  <worldbody>
    <geom type="plane" size="2 2 0.1"/>
    <body pos="0 0 0.4" euler="20 30 10">
      <freejoint/>
      <geom type="box" size="0.1 0.05 0.08"/>
      <site name="corner" pos="0.1 0.05 0.08"/>
    </body>
  </worldbody>
</mujoco>)");
  for (int i = 1; i <= 100; ++i) {
    pair.advance(Time(i * 200ms));
    REQUIRE(pair.apart() < kTolerance);
  }
  CHECK(pair.rests());
}

TEST_CASE("a body that rolls on is not at rest", "[mujoco_world]") {
  Pair pair(worlds::kTumble);
  pair.advance(Time(20s));
  CHECK_FALSE(pair.rests());
  CHECK(pair.apart() == 0);
}

TEST_CASE("a pendulum without friction never rests", "[mujoco_world]") {
  Pair pair(worlds::kPendulum);
  for (int i = 1; i <= 100; ++i) {
    pair.advance(Time(i * 100ms));
    REQUIRE_FALSE(pair.rests());
  }
  CHECK(pair.apart() == 0);
}

TEST_CASE("a lever that falls slowly is not at rest", "[mujoco_world]") {
  // upright but for a nanoradian: it takes 4 s to fall
  Pair pair(R"(
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body>
      <joint name="lever" axis="0 1 0" ref="0"/>
      <geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.02" mass="0.5"/>
    </body>
  </worldbody>
  <keyframe><key name="start" qpos="1e-6"/></keyframe>
</mujoco>)");
  for (int i = 1; i <= 60; ++i) {
    pair.advance(Time(i * 50ms));
    REQUIRE(pair.apart() < kTolerance);
  }
  CHECK(std::abs(pair.plain.joint_position(0)) > 0.5);
}

TEST_CASE("a clock among the sensors is never at rest", "[mujoco_world]") {
  std::string mjcf = servo(5);
  mjcf.replace(mjcf.find("<sensor>"), 8, "<sensor><clock/>");
  Pair pair(mjcf);
  pair.advance(Time(5s));
  CHECK_FALSE(pair.rests());
}

TEST_CASE("an input ends a rest at the same grid point as without one", "[mujoco_world]") {
  Pair pair(servo(5));
  pair.advance(Time(5s));
  REQUIRE(pair.rests());
  pair.advance(Time(5s + 300us));
  pair.set_input(0.5);
  CHECK(pair.resting.rests_until() == pair.resting.now());
  for (int i = 0; i < 100; ++i) {
    pair.advance(pair.plain.now() + 1300us);
    REQUIRE(pair.apart() < kTolerance);
  }
}

TEST_CASE("no rest is longer than it may be", "[mujoco_world]") {
  Pair pair(servo(5), kTolerance, 30ms);
  pair.advance(Time(3s));
  for (int i = 0; i < 200; ++i) {
    pair.advance(pair.plain.now() + 7ms);
    CHECK(pair.resting.rests_until() - pair.resting.now() <= 30ms);
  }
}

TEST_CASE("a rest does not depend on the steps", "[mujoco_world]") {
  const worlds::Folder folder(servo(20));
  World whole(folder.path());
  World split(folder.path());
  for (World* world : {&whole, &split}) {
    world->allow_rest(settings(*world, kTolerance, 200ms));
    world->reset(Time{});
    world->set_input(0, 0.3);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decades(6, 11);
  for (const Time to : {Time(4s), Time(4s + 100us), Time(6s)}) {
    whole.advance(to);
    while (split.now() < to) {
      const Duration step(std::llround(std::pow(10.0, decades(random))));
      split.advance(std::min(to, split.now() + step));
    }
    CHECK(same_bits(saved(whole), saved(split)));
    CHECK(whole.joint_position(0) == split.joint_position(0));
    CHECK(whole.sensor(0) == split.sensor(0));
    for (World* world : {&whole, &split}) world->set_input(0, -0.3);
  }
}

TEST_CASE("a rest goes on from its state", "[mujoco_world]") {
  const worlds::Folder folder(servo(20));
  World world(folder.path());
  world.allow_rest(settings(world));
  world.reset(Time{});
  for (const Time at : {Time(5s + 500us), Time(100ms)}) {
    world.reset(Time{});
    world.advance(at);
    const auto before = saved(world);
    world.advance(at + 2s);
    const auto after = saved(world);
    const double seen = world.sensor(0);
    world.restore(before.data());
    world.advance(at + 2s);
    CHECK(same_bits(saved(world), after));
    CHECK(world.sensor(0) == seen);
  }
}

TEST_CASE("a world that may not rest is not changed by what it could", "[mujoco_world]") {
  const worlds::Folder folder(servo(5));
  World never(folder.path());
  World no_more(folder.path());
  no_more.allow_rest(settings(no_more));
  no_more.forbid_rest();
  never.advance(Time(5s));
  no_more.advance(Time(5s));
  CHECK(same_bits(saved(never), saved(no_more)));
  CHECK(never.rests_until() == never.now());
}
