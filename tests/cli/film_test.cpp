// stride run --film, with the pendulum of mujoco_world.fmu.
#include <cstdlib>
#include <map>
#include <string>

#include <catch2/catch.hpp>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const std::string kWorld = component("world", "mujoco_world.fmu");

Workspace pendulum(const std::string& others = "") { return Workspace(Parts{kWorld + others}); }

/// The run is well; nothing where there is no OpenGL, which is a failure in CI.
bool films(const Workspace& workspace, Arguments arguments = {"--film"}) {
  arguments.push_back("--quiet");
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  if (outcome.err.find("there is no OpenGL") != std::string::npos) {
    WARN("SKIPPED: " << outcome.err);
    REQUIRE(std::getenv("CI") == nullptr);
    return false;
  }
  REQUIRE(outcome.exit_code == 0);
  return true;
}

/// All of the film by name; each picture that is listed is there, and the other way round.
std::map<std::string, std::string> film(const Workspace& workspace,
                                        const std::string& component = "world") {
  const std::string folder = "units/" + component + "/film/";
  std::map<std::string, std::string> files{{"frames.csv", workspace.result(folder + "frames.csv")}};
  const Csv list(workspace / ("out/" + folder + "frames.csv"));
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name = list.row(i)[list.column("file")];
    const std::string picture = workspace.result(folder + name);
    CHECK(picture.substr(0, 2) == "\xff\xd8");
    CHECK(picture.substr(picture.size() - 2) == "\xff\xd9");
    files[name] = picture;
  }
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(workspace / ("out/" + folder))) {
    count += entry.is_regular_file() ? 1 : 0;
  }
  CHECK(count == files.size());
  return files;
}

std::vector<double> times(const Workspace& workspace) {
  return Csv(workspace / "out/units/world/film/frames.csv").numbers("time");
}

const std::vector<double> kQuarters{0, 0.25, 0.5, 0.75, 1};

}  // namespace

TEST_CASE("a film has a picture for each tenth of a second, and changes nothing else") {
  const Workspace workspace = pendulum();
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK_FALSE(fs::exists(workspace / "out/units"));
  const std::string signals = workspace.result("signals.csv");
  if (!films(workspace)) return;
  CHECK(times(workspace) == std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1});
  CHECK(workspace.result("signals.csv") == signals);
  const auto files = film(workspace);
  CHECK(files.at("00001.jpg") != files.at("00000.jpg"));

  CHECK_THAT(workspace.run({"--film=0.5"}).out,
             Contains("Results in out:") && Contains(" units/\n"));

  // the next run is not taken for one with a film
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK_FALSE(fs::exists(workspace / "out/units/world/film/frames.csv"));
}

TEST_CASE("the time between pictures is that of --film, or of the scenario, or 0.1 s") {
  const Workspace workspace = pendulum();
  if (!films(workspace, {"--film=0.25"})) return;
  CHECK(times(workspace) == kQuarters);
  REQUIRE(films(workspace, {"--film", "--set", "world.film.interval=0.5"}));
  CHECK(times(workspace) == std::vector<double>{0, 0.5, 1});
  REQUIRE(films(workspace, {"--film=0.25", "--set", "world.film.interval=0.5"}));
  CHECK(times(workspace) == kQuarters);
  REQUIRE(films(workspace, {"--set", "world.film.interval=0.25"}));
  CHECK(times(workspace) == kQuarters);
}

TEST_CASE("a film is the same wherever the world runs, and whatever the steps are") {
  const Workspace workspace = pendulum();
  if (!films(workspace, {"--film=0.05"})) return;
  const auto expected = film(workspace);
  REQUIRE(expected.size() == 22);
  for (const Arguments& further : {Arguments{"--isolate"},
                                   {"--threads", "2"},
                                   {"--step", "0.0007"},
                                   {"--step", "0.3"},
                                   {"--policy", "event-driven"},
                                   {"--no-idle-skip"}}) {
    INFO(further[0] << " " << further.back());
    Arguments arguments{"--film=0.05"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    REQUIRE(films(workspace, arguments));
    CHECK(film(workspace) == expected);
  }
}

TEST_CASE("a film shows no step that was undone") {
  const Workspace plain = pendulum();
  if (!films(plain, {"--film=0.05"})) return;
  const Workspace controlled(Parts{kWorld + component("filter", "minimal.fmu"),
                                   connection("world.joint.pivot.position", "filter.u")});
  REQUIRE(films(controlled, {"--film=0.05", "--policy", "error-controlled", "--step", "0.2",
                             "--absolute-tolerance", "0.01"}));
  CHECK(run_json(controlled)["units"][0]["rollbacks"] > 0);
  CHECK(film(controlled) == film(plain));
}

TEST_CASE("each world has a film of its own") {
  const Workspace workspace(
      Parts{component("left", "mujoco_world.fmu") + component("right", "mujoco_world.fmu")});
  if (!films(workspace, {"--film=0.25", "--threads", "2", "--set", "right.actuator.pivot=5"})) {
    return;
  }
  CHECK(film(workspace, "left").at("frames.csv") == film(workspace, "right").at("frames.csv"));
  CHECK(film(workspace, "left").at("00003.jpg") != film(workspace, "right").at("00003.jpg"));
}

TEST_CASE("a run that fails leaves its film until then") {
  const Workspace workspace = pendulum(component("faulty", "faulty.fmu"));
  if (!films(workspace)) return;
  CHECK(workspace
            .run({"--quiet", "--film", "--isolate=faulty", "--set", "faulty.fault=abort", "--set",
                  "faulty.at=0.55"})
            .exit_code == 1);
  CHECK(film(workspace).size() == 1 + 6);
  CHECK(run_json(workspace)["outcome"] == "failed");
}

TEST_CASE("--film without a component that can film is an error") {
  const Workspace workspace(Parts{component("filter", "minimal.fmu")});
  CHECK(input_error_of(workspace.run({"--film"})) ==
        "stride: error: --film: no component makes pictures\n"
        "  hint: a unit that does, such as mujoco_world, has the parameter film.interval\n");
}

TEST_CASE("the time between pictures is above 0") {
  const Workspace workspace = pendulum();
  CHECK_THAT(input_error_of(workspace.run({"--film=0"})),
             Contains("--film=0: expected a time above 0") && Contains("such as --film=0.1"));
  CHECK_THAT(input_error_of(workspace.run({"--film=soon"})), Contains("'soon' is not a number"));
  CHECK_THAT(input_error_of(workspace.run({"--film", "--set", "world.film.width=5000"})),
             Contains("film.width") && Contains("expected at most 4096"));
}

TEST_CASE("a requirement of films that is missing is reported before the first step") {
  const Workspace workspace = pendulum();
  const Outcome camera = workspace.run({"--film", "--set", "world.film.camera=side"});
  CHECK(camera.exit_code == 1);
  CHECK_THAT(camera.err,
             Contains("unit 'world'") && Contains("has no camera 'side'; its cameras are: none"));
  ::setenv("MUJOCO_GL", "disable", 1);
  const Outcome open_gl = workspace.run({"--film"});
  ::unsetenv("MUJOCO_GL");
  CHECK(open_gl.exit_code == 1);
  CHECK_THAT(open_gl.err, Contains("MUJOCO_GL is 'disable': expected 'osmesa', 'egl' or none"));
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK(run_json(workspace)["communication_steps"] == 0);
}
