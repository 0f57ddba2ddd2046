// A world whose pictures can be foretold, and what there is to see in them.
#ifndef STRIDE_TESTS_UNITS_MUJOCO_WORLD_FILM_SCENE_H
#define STRIDE_TESTS_UNITS_MUJOCO_WORLD_FILM_SCENE_H

#include <cstdlib>
#include <string>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/film/off_screen.h"
#include "units/mujoco_world/film/picture.h"
#include "units/mujoco_world/model.h"

namespace scene {

using mujoco_world::film::Picture;

/// Seen from the front (x to the right, z up), 2 m away: a red box that the actuator moves along x,
/// a small blue one 0.5 m behind its place, and nothing else.
inline const std::string kBoxes = R"(
<mujoco>
  <option timestep="0.001" gravity="0 0 0"/>
  <visual><headlight ambient="1 1 1" diffuse="0 0 0" specular="0 0 0"/></visual>
  <worldbody>
    <camera name="front" pos="0 -2 0" xyaxes="1 0 0 0 0 1"/>
    <camera name="back" pos="0 2.5 0" xyaxes="-1 0 0 0 0 1"/>
    <body name="red">
      <joint name="x" type="slide" axis="1 0 0" damping="3"/>
      <geom type="box" size="0.2 0.2 0.2" rgba="1 0 0 1" mass="0.1"/>
    </body>
    <geom type="box" pos="0 0.5 0" size="0.1 0.1 0.1" rgba="0 0 1 1"/>
  </worldbody>
  <actuator><position name="x" joint="x" kp="20"/></actuator>
</mujoco>)";

/// Says aloud that there is nothing to draw with, which is a failure in CI.
inline bool lacks_open_gl() {
  try {
    mujoco_world::film::make_off_screen();
    return false;
  } catch (const std::exception& error) {
    WARN("SKIPPED: " << error.what());
    REQUIRE(std::getenv("CI") == nullptr);
    return true;
  }
}

/// Where the pixels of one colour are; no `count`, nothing else.
struct Patch {
  std::size_t count = 0;
  double column = 0, row = 0;  ///< of its middle
};

/// `channel` 0 is red, 1 green, 2 blue: pixels that have much of it and little of the others.
inline Patch patch(const Picture& picture, std::size_t channel) {
  Patch found;
  for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
    bool is_it = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const int value = picture.rgb[3 * i + k];
      is_it = is_it && (k == channel ? value > 150 : value < 80);
    }
    if (!is_it) continue;
    const auto width = static_cast<std::size_t>(picture.width);
    ++found.count;
    found.column += static_cast<double>(i % width);
    found.row += static_cast<double>(i / width);
  }
  if (found.count > 0) {
    found.column /= static_cast<double>(found.count);
    found.row /= static_cast<double>(found.count);
  }
  return found;
}

}  // namespace scene

#endif
