// stride run --scene, with the pendulum of mujoco_world.fmu.
#include <cstdint>
#include <cstring>
#include <string>

#include <catch2/catch.hpp>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const std::string kWorld = component("world", "mujoco_world.fmu");
constexpr const char* kFile = "units/world/world.glb";

Workspace pendulum(const std::string& others = "") { return Workspace(Parts{kWorld + others}); }

/// The scene of a run that is well.
std::string scene(const Workspace& workspace, Arguments arguments) {
  arguments.push_back("--quiet");
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return workspace.result(kFile);
}

/// Its JSON chunk (glTF 2.0, 4.4.3).
nlohmann::json json_of(const std::string& glb) {
  REQUIRE(glb.substr(0, 4) == "glTF");
  std::uint32_t sizes[3];
  std::memcpy(&sizes, glb.data() + 4, sizeof sizes);
  REQUIRE(sizes[1] == glb.size());
  return nlohmann::json::parse(glb.substr(20, sizes[2]));
}
nlohmann::json notes_of(const std::string& glb) {
  return json_of(glb)["scenes"][0]["extras"]["stride"];
}

}  // namespace

TEST_CASE("a scene is a glTF file of the whole run, and changes nothing else") {
  const Workspace workspace = pendulum();
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK_FALSE(fs::exists(workspace / "out/units"));
  const std::string signals = workspace.result("signals.csv");
  const nlohmann::json notes = notes_of(scene(workspace, {"--scene"}));
  CHECK(notes["startTime"] == "0");
  CHECK(notes["stopTime"] == "1");
  CHECK(notes["interval"] == 0.1);
  CHECK(notes["samples"] == 11);
  CHECK(workspace.result("signals.csv") == signals);

  // the next run is not taken for one with a scene
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK_FALSE(fs::exists(workspace / ("out/" + std::string(kFile))));
}

TEST_CASE("the time between poses is that of --scene, or of the scenario, or 0.1 s") {
  const Workspace workspace = pendulum();
  const auto interval = [&](const Arguments& arguments) {
    return notes_of(scene(workspace, arguments))["interval"];
  };
  CHECK(interval({"--scene=0.25"}) == 0.25);
  CHECK(interval({"--scene", "--set", "world.scene.interval=0.5"}) == 0.5);
  CHECK(interval({"--scene=0.25", "--set", "world.scene.interval=0.5"}) == 0.25);
  CHECK(interval({"--set", "world.scene.interval=0.125"}) == 0.125);
}

TEST_CASE("a scene is the same wherever the world runs, and whatever the steps are") {
  const Workspace workspace = pendulum();
  const std::string expected = scene(workspace, {"--scene=0.05"});
  for (const Arguments& further : {Arguments{"--isolate"},
                                   {"--threads", "2"},
                                   {"--step", "0.0007"},
                                   {"--step", "0.3"},
                                   {"--policy", "event-driven"},
                                   {"--no-idle-skip"}}) {
    INFO(further[0] << " " << further.back());
    Arguments arguments{"--scene=0.05"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    CHECK((scene(workspace, arguments) == expected));
  }
}

TEST_CASE("a scene shows no step that was undone") {
  const Workspace plain = pendulum();
  const std::string expected = scene(plain, {"--scene=0.05"});
  const Workspace controlled(Parts{kWorld + component("filter", "minimal.fmu"),
                                   connection("world.joint.pivot.position", "filter.u")});
  CHECK((scene(controlled, {"--scene=0.05", "--policy", "error-controlled", "--step", "0.2",
                            "--absolute-tolerance", "0.01"}) == expected));
  CHECK(run_json(controlled)["units"][0]["rollbacks"] > 0);
}

TEST_CASE("a run that fails leaves its scene until then") {
  const Workspace workspace = pendulum(component("faulty", "faulty.fmu"));
  CHECK(workspace
            .run({"--quiet", "--scene", "--isolate=faulty", "--set", "faulty.fault=abort", "--set",
                  "faulty.at=0.55"})
            .exit_code == 1);
  const nlohmann::json notes = notes_of(workspace.result(kFile));
  CHECK(std::stod(notes["stopTime"].get<std::string>()) >= 0.5);
  CHECK(notes["samples"] == 7);  // at 0, 0.1 … 0.5, and at the end
}

TEST_CASE("a run that is resumed goes on with its scene") {
  const Workspace workspace = pendulum();
  const std::string expected = scene(workspace, {"--scene=0.05"});
  Arguments arguments{"--scene=0.05", "--checkpoint", "0.33"};
  CHECK((scene(workspace, arguments) == expected));
  const fs::path checkpoint = [&] {
    for (const auto& entry : fs::recursive_directory_iterator(workspace / "out")) {
      if (entry.path().extension() == ".zip") return entry.path();
    }
    return fs::path();
  }();
  REQUIRE_FALSE(checkpoint.empty());
  const Outcome outcome = workspace.stride({"resume", checkpoint.string(), "--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK((workspace.result(kFile) == expected));
}

TEST_CASE("--scene without a component that has one is an error, and so is no interval") {
  CHECK(input_error_of(Workspace(Parts{component("filter", "minimal.fmu")}).run({"--scene"})) ==
        "stride: error: --scene: no component writes a scene\n"
        "  hint: a unit that does, such as mujoco_world, has the parameter scene.interval\n");
  const Workspace workspace = pendulum();
  CHECK_THAT(input_error_of(workspace.run({"--scene=0"})),
             Contains("--scene=0: expected a time above 0") && Contains("such as --scene=0.1"));
  CHECK_THAT(input_error_of(workspace.run({"--scene=soon"})), Contains("'soon' is not a number"));
}
