// The film of the flagship scenario shows what the device does.
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/units/mujoco_world/film/jpeg.h"
#include "tests/units/mujoco_world/film/scene.h"

using namespace stride::tests;

namespace {

/// Of the film's picture of that time. Nothing else in this world is of a pure red.
std::size_t red_pixels(const ScenarioRun& run, const std::string& time) {
  const Csv list(run.file("units/world/film/frames.csv"));
  const std::string name = list.row(list.row_at(time))[list.column("file")];
  std::ifstream file(run.file("units/world/film/" + name), std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  return scene::patch(decoded(bytes), 0).count;
}

}  // namespace

TEST_CASE("the sensor's LED lights up in the film, and goes off with its power") {
  if (scene::lacks_open_gl()) return;
  Arguments arguments = without_judge("nfc_approach");
  arguments.insert(arguments.end(), {"--film=0.2", "--stop", "15.2"});
  const ScenarioRun run("nfc_approach", arguments);
  for (const char* time : {"0", "14", "14.2", "14.4", "14.6", "14.8", "15", "15.2"}) {
    INFO("at " << time << " s, the LED is " << run.at(time, "sensor.led"));
    CHECK((red_pixels(run, time) > 8) == (run.at(time, "sensor.led") == 1));
  }
  CHECK(red_pixels(run, "14.2") == 0);  // the command is on its way
  CHECK(run.at("14.4", "sensor.led") == 1);
}
