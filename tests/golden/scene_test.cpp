// The scene of the flagship scenario shows what the device does.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"
#include "tests/units/mujoco_world/scene/glb.h"

using namespace stride::tests;

TEST_CASE("the sensor's LED is lit in the scene at the very instants at which it is on") {
  Arguments arguments = without_judge("nfc_approach");
  arguments.insert(arguments.end(), {"--scene", "--stop", "15.2"});
  const ScenarioRun run("nfc_approach", arguments);
  const Glb glb(run.file("units/world/world.glb"));
  const Csv& signals = run.signals();
  const auto times = signals.numbers("time");
  const auto led = signals.numbers("sensor.led");
  std::size_t switched = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0 && led[i] != led[i - 1]) ++switched;
    const bool is_right = glb.is_there(glb.lamp(true), times[i]) == (led[i] == 1) &&
                          glb.is_there(glb.lamp(false), times[i]) == (led[i] == 0);
    if (!is_right) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK(switched == 2);
  CHECK(glb.times(glb.lamp(true), "scale").size() == 3);
}

TEST_CASE("the sites of the scene are where the signals have them") {
  Arguments arguments = without_judge("nfc_approach");
  arguments.insert(arguments.end(), {"--scene", "--stop", "6", "--signals", "world.site.*"});
  const ScenarioRun run("nfc_approach", arguments);
  const Glb glb(run.file("units/world/world.glb"));
  const int coil = glb.node("site", "reader_coil");
  for (const char* time : {"0", "1.5", "3.2", "4.8", "6"}) {
    INFO(time);
    const Eigen::Affine3d pose = glb.pose(coil, std::stod(time));
    const char* const names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      const std::string site = "world.site.reader_coil.";
      // 1e-6 rad of each of six joints, up to a metre away
      CHECK(pose.translation()[i] ==
            Approx(run.at(time, site + "position." + names[i] + " [m]")).margin(5e-6));
      CHECK(pose.linear()(i, 2) == Approx(run.at(time, site + "axis." + names[i])).margin(1e-5));
    }
  }
}

TEST_CASE("the field of the reader is as large in the scene as the channel says, where connected") {
  const ScratchFolder scratch;
  const auto folder = scenario_folder("nfc_approach");
  std::string text = text_of(folder / "nfc_approach.ssd");
  const std::string end = "</ssd:Connections>";
  text.insert(text.rfind(end),
              R"(<ssd:Connection startElement="channel" startConnector="field_reach")"
              R"( endElement="world" endConnector="field.reader_coil"/>)");
  std::ofstream(scratch / "field.ssd") << text;
  for (const char* parameters : {"sensor.ssv", "ground_truth.ssv"}) {
    std::filesystem::copy_file(folder / parameters, scratch / parameters);
  }
  Arguments arguments = without_judge("nfc_approach");
  arguments.insert(arguments.end(), {"--scene", "--stop", "10.5", "--no-checks", "--signals",
                                     "channel.field_reach"});
  const ScenarioRun run((scratch / "field.ssd").string(), arguments);
  const Glb glb(run.file("units/world/world.glb"));
  const int field = glb.node("field", "reader_coil");
  const auto times = run.signals().numbers("time");
  const auto reaches = run.signals().numbers("channel.field_reach [m]");
  for (const double time : {6.0, 6.0999, 6.1, 6.5, 7.0, 8.5, 8.9999, 9.0, 10.0}) {
    INFO(time);
    const auto behind = std::upper_bound(times.begin(), times.end(), time) - times.begin();
    const double reach = reaches[static_cast<std::size_t>(behind - 1)];
    CHECK(glb.pose(field, time).linear().col(2).norm() == Approx(reach).epsilon(0.005));
    CHECK((reach > 0.05) == (time >= 6.1 && time < 9));
  }
}
