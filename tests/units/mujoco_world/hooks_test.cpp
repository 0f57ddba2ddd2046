#include "units/mujoco_world/hooks.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/model.h"

using mujoco_world::guarded;
using mujoco_world::take_warnings;

TEST_CASE("an error of MuJoCo is an exception", "[mujoco_world]") {
  CHECK_THROWS_WITH(guarded([] { mju_error("as it should"); }), Catch::Contains("as it should"));
}

TEST_CASE("a warning of MuJoCo is kept, and no log file is written", "[mujoco_world]") {
  take_warnings();
  guarded([] { mju_warning("mind this"); });
  const auto warnings = take_warnings();
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::Contains("mind this"));
  CHECK(take_warnings().empty());
  CHECK_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST_CASE("an error deep inside MuJoCo's step leaves the world restorable", "[mujoco_world]") {
  // enough memory for bodies in the air, too little for their contacts
  const bool is_mujoco2 = mjVERSION_HEADER < 3000000;
  std::string mjcf = std::string("<mujoco><size ") +
                     (is_mujoco2 ? "nstack='3000'" : "memory='9K'") +
                     "/><worldbody><geom type='plane' size='9 9 1'/>";
  for (int i = 0; i < 6; ++i) {
    mjcf += "<body pos='" + std::to_string(i) + " 0 0.2'><freejoint/><geom size='0.1'/></body>";
  }
  const worlds::Folder folder(mjcf + "</worldbody></mujoco>");
  mujoco_world::World world(folder.path());
  world.advance(stride::time_from_seconds(0.1));
  std::vector<double> state(world.state_size());
  world.save(state.data());

  const auto fall = [&] { world.advance(stride::time_from_seconds(1)); };
  REQUIRE_THROWS_WITH(fall(), Catch::Contains("MuJoCo failed at 0.1") &&
                                  Catch::Contains("stack overflow", Catch::CaseSensitive::No));
  // and again, many times: a leak of stack would fail earlier and earlier
  for (int i = 0; i < 20; ++i) {
    world.restore(state.data());
    world.advance(stride::time_from_seconds(0.12));
    CHECK_THROWS_WITH(fall(), Catch::Contains("MuJoCo failed at 0.1"));
  }
}
