#include "units/mujoco_world/model.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/units/mujoco_world/states.h"
#include "tests/units/mujoco_world/worlds.h"

namespace {

using mujoco_world::World;
using stride::Duration;
using stride::Time;

using stride::tests::at;

using worlds::same_bits;
using worlds::saved;

/// Everything that is seen at the current instant.
std::vector<double> outputs(const World& world) {
  std::vector<double> values;
  const auto append = [&](const auto& more) {
    values.insert(values.end(), more.begin(), more.end());
  };
  const auto& catalogue = world.catalogue();
  for (std::size_t i = 0; i < catalogue.joints.size(); ++i) {
    values.push_back(world.joint_position(i));
    values.push_back(world.joint_velocity(i));
  }
  for (std::size_t i = 0; i < catalogue.sites.size(); ++i) {
    append(world.site_position(i));
    append(world.site_axis(i));
    append(world.site_velocity(i));
    append(world.site_axis_rate(i));
  }
  for (std::size_t i = 0; i < catalogue.sensors.size(); ++i) {
    for (int k = 0; k < catalogue.sensors[i].dimension; ++k) values.push_back(world.sensor(i, k));
  }
  return values;
}

/// Advances in steps of anything from 1 ps to several timesteps, looking at the outputs now and
/// then.
void advance_at_random(World& world, Time to, std::mt19937& random) {
  std::uniform_real_distribution<double> decades(0, 10.1);
  while (world.now() < to) {
    const Duration step(std::llround(std::pow(10.0, decades(random))));
    world.advance(std::min(to, world.now() + step));
    if (random() % 4 == 0) outputs(world);
  }
}

}  // namespace

TEST_CASE("a step may be split anywhere", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World whole(folder.path());
  World single(folder.path());
  World split(folder.path());
  std::mt19937 random(1);

  // inputs change on and off the grid of 2 ms
  Time now{};
  for (int i = 0; i < 10; ++i) {
    for (World* world : {&whole, &single, &split}) world->set_input(0, i % 2 ? -1.2 : 1.2);
    const Time next = now + (i % 3 ? Duration(100'000'000'000) : Duration(100'700'000'123));
    whole.advance(next);
    while (single.now() < next) {
      single.advance(std::min(next, single.now() + single.timestep()));
    }
    advance_at_random(split, next, random);
    now = next;
    REQUIRE(same_bits(saved(whole), saved(single)));
    REQUIRE(same_bits(saved(whole), saved(split)));
    REQUIRE(same_bits(outputs(whole), outputs(split)));
  }
  // and it was no still life
  CHECK(std::abs(whole.joint_position(0)) > 0.1);
  CHECK(whole.site_position(0)[2] < 0.3);
}

TEST_CASE("an input is taken at the next grid point", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kPendulum);
  World world(folder.path());
  World undriven(folder.path());
  const Duration step = world.timestep();

  undriven.advance(Time{} + 2 * step);
  world.advance(Time{} + step / 2);
  world.set_input(0, 3);
  world.advance(Time{} + step);
  CHECK(world.joint_velocity(0) == Approx(undriven.joint_velocity(0) / 2).epsilon(1e-3));

  SECTION("in force from there") {
    world.advance(Time{} + 2 * step);
    CHECK(world.joint_velocity(0) - undriven.joint_velocity(0) == Approx(3e-3).epsilon(1e-3));
  }
  SECTION("unless replaced at that very point") {
    world.set_input(0, 0);
    world.advance(Time{} + 2 * step);
    CHECK(world.joint_velocity(0) == undriven.joint_velocity(0));
  }
}

TEST_CASE("an input does not show in the outputs of its own instant", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  world.advance(at(0.1));
  const auto before = outputs(world);
  world.set_input(0, 1);
  CHECK(same_bits(before, outputs(world)));
}

TEST_CASE("a restored state replays to the same bits", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  world.set_input(0, 1.2);
  const Time checkpoint = at(0.3) + GENERATE(Duration(0), Duration(700'000'001));
  world.advance(checkpoint);
  const auto state = saved(world);
  const auto seen = outputs(world);
  world.advance(at(0.9));
  const auto end = saved(world);

  SECTION("in the same world") {
    world.set_input(0, -1.2);
    world.advance(at(1.5));
    world.restore(state.data());
    CHECK(world.now() == checkpoint);
    CHECK(world.input(0) == 1.2);
    CHECK(same_bits(seen, outputs(world)));
    world.advance(at(0.9));
    CHECK(same_bits(end, saved(world)));
  }
  SECTION("in another world") {
    World other(folder.path());
    other.restore(state.data());
    other.advance(at(0.9));
    CHECK(same_bits(end, saved(other)));
  }
}

TEST_CASE("reset repeats the run, from any start time", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  world.set_input(0, 1);
  world.advance(at(0.5005));
  const auto seen = outputs(world);
  world.reset(at(4321.0001));
  CHECK(world.input(0) == 0);
  world.set_input(0, 1);
  world.advance(at(4321.0001) + Duration(500'500'000'000));
  CHECK(same_bits(seen, outputs(world)));
}

TEST_CASE("two worlds in two threads give the results that each gives alone", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World alone(folder.path());
  alone.advance(at(0.5));

  std::vector<double> results[2];
  const auto run = [&](std::vector<double>& result) {
    World world(folder.path());
    world.advance(at(0.5));
    result = saved(world);
  };
  std::thread first(run, std::ref(results[0]));
  std::thread second(run, std::ref(results[1]));
  first.join();
  second.join();
  CHECK(same_bits(results[0], saved(alone)));
  CHECK(same_bits(results[1], saved(alone)));
}

namespace {

/// A servo of 100 N.m/rad on a hinge, 0.1 s and critically damped, in no gravity.
std::string servo(const std::string& custom) {
  return R"(<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" gravity="0 0 0"/>
  <custom>)" +
         custom + R"(</custom>
  <worldbody><body>
    <joint name="axis" axis="0 0 1" damping="20"/>
    <geom type="box" size="0.1 0.1 0.1" mass="150"/>
  </body></worldbody>
  <actuator><position name="drive" joint="axis" kp="100"/></actuator>
</mujoco>)";
}

}  // namespace

TEST_CASE("a drive's ripple is added to its command, by the joint's position", "[mujoco_world]") {
  const worlds::Folder folder(servo(R"(<numeric name="drive_ripple.drive" data="0.01 20"/>)"));
  World world(folder.path());
  world.set_input(0, 0.3);
  world.advance(at(20));
  const double q = world.joint_position(0);
  CHECK(q == Approx(0.3 + 0.01 * std::sin(20 * q)).epsilon(1e-9));
  CHECK(std::abs(q - 0.3) > 1e-3);
  CHECK(world.input(0) == 0.3);

  // and is none of the state that a restored world needs
  world.set_input(0, 0.5);
  world.advance(at(20.05));
  std::vector<double> block(world.state_size());
  world.save(block.data());
  world.advance(at(21));
  const double expected = world.joint_position(0);
  World other(folder.path());
  other.restore(block.data());
  other.advance(at(21));
  CHECK(other.joint_position(0) == expected);
}

TEST_CASE("a world whose drives ripple rests all the same", "[mujoco_world]") {
  const worlds::Folder folder(servo(R"(<numeric name="drive_ripple.drive" data="0.01 20"/>)"));
  World world(folder.path());
  mujoco_world::RestSettings settings;
  settings.tolerances.joint_positions = {1e-4};
  settings.tolerances.joint_velocities = {1e-3};
  settings.tolerances.site_positions.clear();
  settings.tolerances.site_axes.clear();
  world.allow_rest(settings);
  world.reset(Time{});
  world.set_input(0, 0.3);
  world.advance(at(20));
  CHECK(world.rests_until() > world.now());
}

TEST_CASE("a ripple of something else than a drive is an error", "[mujoco_world]") {
  for (const char* custom : {R"(<numeric name="drive_ripple.axis" data="0.01 20"/>)",
                             R"(<numeric name="drive_ripple.drive" data="0.01"/>)"}) {
    const worlds::Folder folder(servo(custom));
    CHECK_THROWS_WITH(World(folder.path()), Catch::Contains("drive_ripple."));
  }
}

TEST_CASE("a lamp is part of the state, and off at the start", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kLamp);
  World world(folder.path());
  REQUIRE(world.catalogue().lamps.size() == 1);
  CHECK(world.catalogue().lamps[0].name == "led");
  CHECK(world.display().shining.empty());
  world.set_lamp(0, true);
  CHECK(world.display().shining == std::vector<int>{world.catalogue().lamps[0].geom});
  std::vector<double> lit(world.state_size());
  world.save(lit.data());
  world.set_lamp(0, false);
  world.restore(lit.data());
  CHECK(world.display().shining.size() == 1);
  world.reset(Time{});
  CHECK(world.display().shining.empty());
}

TEST_CASE("a field is part of the state, and none at the start", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kField);
  World world(folder.path());
  REQUIRE(world.catalogue().fields.size() == 1);
  CHECK(world.catalogue().fields[0].name == "coil");
  CHECK((world.has_display() && world.display() == mujoco_world::Display{}));
  world.set_field(0, 0.25);
  const mujoco_world::Display there{{}, {{world.catalogue().fields[0].site, 0.25}}};
  CHECK(world.display() == there);
  std::vector<double> state(world.state_size());
  world.save(state.data());
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    world.set_field(0, none);
    CHECK(world.display().fields.empty());
  }
  world.restore(state.data());
  CHECK(world.display() == there);
  world.reset(Time{});
  CHECK(world.display().fields.empty());
}

TEST_CASE("a pendulum swings with the period of the elliptic integral", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kPendulum);
  World world(folder.path());
  const double amplitude = world.joint_position(0);
  REQUIRE(amplitude == 2);

  std::vector<double> downward_crossings;
  while (downward_crossings.size() < 4) {
    const Time before = world.now();
    const double angle = world.joint_position(0);
    world.advance(before + world.timestep());
    if (angle > 0 && world.joint_position(0) <= 0) {
      downward_crossings.push_back(stride::to_seconds(before) - angle / world.joint_velocity(0));
    }
  }
  // T = 4 sqrt(I / (m g l)) K(sin(amplitude / 2)); I of a sphere of 1 cm, 1 m away
  const double inertia = 1 + 0.4 * 0.01 * 0.01;
  const double period = 4 * std::sqrt(inertia / 9.81) * std::comp_ellint_1(std::sin(amplitude / 2));
  CHECK((downward_crossings.back() - downward_crossings.front()) / 3 ==
        Approx(period).epsilon(1e-6));
}

TEST_CASE("between grid points the pose follows the velocity", "[mujoco_world]") {
  const std::string coarse = worlds::kTumble;  // timestep 2 ms
  std::string fine = coarse;
  fine.replace(fine.find("0.002"), 5, "0.00001");
  const worlds::Folder coarse_folder(coarse);
  const worlds::Folder fine_folder(fine);
  World world(coarse_folder.path());
  World reference(fine_folder.path());

  // falling and spinning, no contact yet
  const Time grid = at(0.1);
  world.advance(grid);
  reference.advance(grid);
  for (std::size_t site : {std::size_t{0}, std::size_t{1}}) {
    const double offset = world.site_position(site)[2] - reference.site_position(site)[2];
    CHECK(std::abs(offset) < 2e-3);
  }
  const auto held = world.site_position(1);
  const auto exact_held = reference.site_position(1);
  world.advance(grid + Duration(1'500'000'000));
  reference.advance(grid + Duration(1'500'000'000));
  const double moved = world.site_position(1)[2] - held[2];
  const double exact = reference.site_position(1)[2] - exact_held[2];
  // 1.5 ms at 1 m/s; the acceleration which is left out bends the path by g t^2 / 2 = 11 um
  CHECK(exact == Approx(-1.5e-3).epsilon(0.1));
  CHECK(moved == Approx(exact).margin(50e-6));
}

TEST_CASE("a quaternion turns along its velocity between grid points", "[mujoco_world]") {
  const worlds::Folder folder(R"(
    <mujoco>
      <option timestep="0.1" gravity="0 0 0"/>
      <worldbody>
        <body><freejoint/><geom size="0.1"/><site name="mark" pos="1 0 0" euler="0 90 0"/></body>
      </worldbody>
      <keyframe><key name="start" qpos="0 0 0 1 0 0 0" qvel="0 0 0 0 0 2"/></keyframe>
    </mujoco>)");
  World world(folder.path());
  const double instant = GENERATE(0.05, 0.1, 0.13, 0.7299);
  world.advance(at(instant));
  CHECK(world.site_position(0)[0] == Approx(std::cos(2 * instant)).margin(1e-9));
  CHECK(world.site_position(0)[1] == Approx(std::sin(2 * instant)).margin(1e-9));
  CHECK(world.site_axis(0)[0] == Approx(std::cos(2 * instant)).margin(1e-9));
  CHECK(world.site_axis(0)[1] == Approx(std::sin(2 * instant)).margin(1e-9));
}

TEST_CASE("rates are the derivatives of positions and axes", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  world.set_input(0, 1.2);
  const std::size_t site = GENERATE(0, 1, 2);
  const Time grid = at(0.25);
  world.advance(grid);
  const Duration half(500'000'000);
  world.advance(grid + half);
  const auto velocity = world.site_velocity(site);
  const auto axis_rate = world.site_axis_rate(site);
  CHECK(std::hypot(velocity[0], velocity[1], velocity[2]) > 0.05);

  std::vector<double> state = saved(world);
  world.advance(grid + half + Duration(1'000'000));
  const auto position_after = world.site_position(site);
  const auto axis_after = world.site_axis(site);
  world.restore(state.data());
  const auto position = world.site_position(site);
  const auto axis = world.site_axis(site);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK((position_after[k] - position[k]) / 1e-6 == Approx(velocity[k]).margin(1e-4));
    CHECK((axis_after[k] - axis[k]) / 1e-6 == Approx(axis_rate[k]).margin(1e-4));
  }
}

TEST_CASE("sensors are seen at the instant, not at the last grid point", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kPendulum);
  World world(folder.path());
  world.advance(at(0.3004));
  CHECK(world.sensor(0) == world.joint_position(0));
  CHECK(std::hypot(world.sensor(1, 0), world.sensor(1, 2)) ==
        Approx(std::abs(world.joint_velocity(0))));
  CHECK_THROWS_AS(world.sensor(0, 1), std::out_of_range);
}

TEST_CASE("the timestep is a whole number of picoseconds", "[mujoco_world]") {
  std::string mjcf = worlds::kPendulum;
  const auto with_timestep = [&](const std::string& text) {
    return std::string(mjcf).replace(mjcf.find("0.001"), 5, text);
  };
  const worlds::Folder third(with_timestep("0.00333333333333333"));
  CHECK(World(third.path()).timestep() == Duration(3'333'333'333));
  const worlds::Folder tiny(with_timestep("1e-13"));
  CHECK_THROWS_WITH(World(tiny.path()), Catch::Contains("at least one picosecond"));
}

TEST_CASE("diverging motion is an error which names the joint and the time", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kRunaway);
  World world(folder.path());
  world.set_input(0, 1);
  world.advance(at(0.01));
  const auto state = saved(world);
  world.advance(at(0.011));
  const auto healthy = saved(world);

  REQUIRE_THROWS_WITH(world.advance(at(10)), Catch::Contains("'runaway' of body 'rotor'") &&
                                                 Catch::Contains("diverged in the step from 0."));
  CHECK_THROWS_AS(world.advance(at(11)), std::logic_error);

  world.restore(state.data());
  world.advance(at(0.011));
  CHECK(same_bits(healthy, saved(world)));
}

TEST_CASE("wrong calls are refused", "[mujoco_world]") {
  const worlds::Folder folder(worlds::kPendulum);
  World world(folder.path());
  CHECK_THROWS_WITH(world.set_input(0, std::nan("")), Catch::Contains("'pivot'"));
  CHECK_THROWS_AS(world.set_input(1, 0), std::out_of_range);
  world.advance(at(0.1));
  CHECK_THROWS_AS(world.advance(at(0.05)), std::invalid_argument);
}
