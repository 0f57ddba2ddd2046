// The world seen by an importer: its start as parameters, and steps that end at contacts.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/interfaces/unit/saved_state.h"
#include "tests/scratch_folder.h"
#include "tests/units/mujoco_world/film/scene.h"
#include "tests/units/mujoco_world/worlds.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

class WorldUnit {
 public:
  explicit WorldUnit(const std::string& mjcf, bool early_return = false) : folder_(mjcf) {
    make(early_return);
  }
  /// Whose results are in that folder.
  WorldUnit(const std::string& mjcf, const std::filesystem::path& results) : folder_(mjcf) {
    ::setenv("STRIDE_RESULTS", results.c_str(), 1);
    make(false);
    ::unsetenv("STRIDE_RESULTS");
  }

  UnitInstance* operator->() { return &*unit_; }

  fmi3Status set_keyframe(const char* name) {
    const fmi3ValueReference r = unit_->reference("start.keyframe");
    return library_.SetString(unit_->handle, &r, 1, &name, 1);
  }
  bool touches(const std::string& contact) {
    const fmi3ValueReference r = unit_->reference("contact." + contact);
    bool value = false;
    REQUIRE(library_.GetBoolean(unit_->handle, &r, 1, &value, 1) == fmi3OK);
    return value;
  }
  /// How often a text was logged.
  long said(const std::string& text) const {
    return std::count_if(unit_->messages.begin(), unit_->messages.end(), [&](const auto& message) {
      return message.find(text) != std::string::npos;
    });
  }
  const std::string& description() const { return description_; }
  UnitInstance& instance() { return *unit_; }

 private:
  void make(bool early_return) {
    InstanceChoices choices;
    choices.resources = (folder_.path() / "").string();
    choices.early_return = early_return;
    choices.logging = true;
    unit_.emplace(library_, choices);
    description_ = library_.describe(choices.resources);
  }

  worlds::Folder folder_;
  UnitLibrary library_{unit_library("mujoco_world")};
  std::optional<UnitInstance> unit_;
  std::string description_;
};

/// By name, with their contents.
std::map<std::string, std::string> film_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

/// With a film, up to 0.05 s.
void start_filmed(WorldUnit& world) {
  REQUIRE(world->set_real("film.interval", 0.02) == fmi3OK);
  REQUIRE(world->start_steps() == fmi3OK);
  REQUIRE(world->step(0, 0.05) == fmi3OK);
}

/// From there to 0.1 s.
void finish(WorldUnit& world) {
  for (int i = 0; i < 5; ++i) REQUIRE(world->step(0.05 + 0.01 * i, 0.01) == fmi3OK);
  REQUIRE(world->fmi.Terminate(world->handle) == fmi3OK);
}

/// With a film of the world worlds::kLamp, up to the first step.
void start_lamp(WorldUnit& world) {
  REQUIRE(world->set_real("film.interval", 0.02) == fmi3OK);
  REQUIRE(world->start_steps() == fmi3OK);
}

void light(WorldUnit& world, bool on) {
  REQUIRE(world->fmi.EnterEventMode(world->handle) == fmi3OK);
  REQUIRE(world->set_boolean("lamp.led", on) == fmi3OK);
  REQUIRE(world->update() == fmi3OK);
  REQUIRE(world->fmi.EnterStepMode(world->handle) == fmi3OK);
}

}  // namespace

TEST_CASE("a film goes on where a serialised state is restored", "[mujoco_world]") {
  if (scene::lacks_open_gl()) return;
  const ScratchFolder scratch;
  WorldUnit whole(worlds::kTumble, scratch / "whole");
  start_filmed(whole);
  finish(whole);
  std::vector<fmi3Byte> bytes;
  {
    WorldUnit cut(worlds::kTumble, scratch / "cut");
    start_filmed(cut);
    bytes = serialized(cut.instance());
    REQUIRE(cut->step(0.05, 0.05) == fmi3OK);  // which is lost
  }
  const bool is_initialized = GENERATE(false, true);
  WorldUnit resumed(worlds::kTumble, scratch / "cut");
  if (is_initialized) {
    REQUIRE(resumed->set_real("film.interval", 0.02) == fmi3OK);
    REQUIRE(resumed->start_steps() == fmi3OK);
  }
  REQUIRE(restore(resumed.instance(), bytes) == fmi3OK);
  CHECK(film_files(scratch / "cut/film").size() == 4);  // at 0, 0.02 and 0.04 s, and the list
  CHECK(serialized(resumed.instance()) == bytes);
  finish(resumed);
  CHECK(film_files(scratch / "cut/film") == film_files(scratch / "whole/film"));
  CHECK(resumed.said("lacks pictures") == 0);
}

TEST_CASE("a run without a step has a film of one picture", "[mujoco_world]") {
  if (scene::lacks_open_gl()) return;
  const ScratchFolder scratch;
  WorldUnit world(worlds::kTumble, scratch / "run");
  REQUIRE(world->set_real("film.interval", 0.02) == fmi3OK);
  REQUIRE(world->start_steps() == fmi3OK);
  REQUIRE(world->fmi.Terminate(world->handle) == fmi3OK);
  CHECK(film_files(scratch / "run/film").size() == 2);
}

TEST_CASE("a picture shows a lamp as it is from that instant on", "[mujoco_world]") {
  if (scene::lacks_open_gl()) return;
  const ScratchFolder scratch;
  WorldUnit world(worlds::kLamp, scratch / "run");
  const auto film = [&] { return film_files(scratch / "run/film"); };
  start_lamp(world);
  REQUIRE(world->step(0, 0.02) == fmi3OK);
  const std::string dark = film().at("00000.jpg");
  CHECK(film().at("00001.jpg") == dark);
  light(world, true);
  REQUIRE(world->step(0.02, 0.01) == fmi3OK);
  const std::string lit = film().at("00001.jpg");
  CHECK(lit != dark);
  REQUIRE(world->step(0.03, 0.01) == fmi3OK);
  CHECK(film().at("00000.jpg") == dark);
  CHECK(film().at("00002.jpg") == lit);
  light(world, false);
  REQUIRE(world->fmi.Terminate(world->handle) == fmi3OK);
  CHECK(film().at("00001.jpg") == lit);
  CHECK(film().at("00002.jpg") == dark);
  CHECK(film().at("frames.csv") == "time,file\n0,00000.jpg\n0.02,00001.jpg\n0.04,00002.jpg\n");
}

TEST_CASE("a lamp in a step that was undone is in no picture", "[mujoco_world]") {
  if (scene::lacks_open_gl()) return;
  const bool is_lit = GENERATE(false, true);  // in what counts
  const bool is_elsewhere = GENERATE(false, true);
  const ScratchFolder scratch;
  WorldUnit world(worlds::kLamp, scratch / "run");
  start_lamp(world);
  REQUIRE(world->step(0, 0.02) == fmi3OK);
  const std::vector<fmi3Byte> bytes = serialized(world.instance());
  light(world, !is_lit);
  REQUIRE(world->step(0.02, 0.01) == fmi3OK);
  light(world, is_lit);
  REQUIRE(world->step(0.03, 0.02) == fmi3OK);
  WorldUnit other(worlds::kLamp, scratch / "run");
  WorldUnit& resumed = is_elsewhere ? other : world;
  REQUIRE(restore(resumed.instance(), bytes) == fmi3OK);
  light(resumed, is_lit);
  REQUIRE(resumed->step(0.02, 0.02) == fmi3OK);
  const auto film = film_files(scratch / "run/film");
  CHECK((film.at("00001.jpg") != film.at("00000.jpg")) == is_lit);
  CHECK(film.at("00002.jpg") == film.at("00001.jpg"));
}

TEST_CASE("a lamp of a world that is idle shines from the instant at which it is lit",
          "[mujoco_world]") {
  if (scene::lacks_open_gl()) return;
  const ScratchFolder scratch;
  WorldUnit world(worlds::kLamp, scratch / "run");
  REQUIRE(world->fmi.EnableIdleSkipping(world->handle, 100) == fmi3OK);
  start_lamp(world);
  REQUIRE(world->step(0, 0.1) == fmi3OK);
  REQUIRE(world->idle_until() > 0.2);
  REQUIRE(world->step(0.1, 0.05) == fmi3OK);  // it catches up
  light(world, true);
  CHECK(world->idle_until() > 0.2);  // a lamp moves nothing
  REQUIRE(world->step(0.15, 0.05) == fmi3OK);
  const auto film = film_files(scratch / "run/film");
  REQUIRE(film.size() == 12);
  for (const char* dark : {"00001.jpg", "00007.jpg"}) CHECK(film.at(dark) == film.at("00000.jpg"));
  CHECK(film.at("00008.jpg") != film.at("00000.jpg"));
  CHECK(film.at("00010.jpg") == film.at("00008.jpg"));
}

TEST_CASE("a lamp is an input that moves nothing", "[mujoco_world]") {
  std::string mjcf = worlds::kTumble;
  mjcf.insert(mjcf.find("<worldbody>"), "<custom><text name=\"lamps\" data=\"led\"/></custom>");
  mjcf.insert(mjcf.find("<geom type=\"capsule\"") + 5, " name=\"led\"");
  WorldUnit dark(mjcf);
  WorldUnit lit(mjcf);
  CHECK(attribute(lit.description(), "name=\"lamp.led\"", "start") == "false");
  REQUIRE(dark->start_steps() == fmi3OK);
  REQUIRE(lit->start_steps() == fmi3OK);
  for (int i = 0; i < 100; ++i) {
    light(lit, i % 3 == 0);
    REQUIRE(dark->step(0.005 * i, 0.005) == fmi3OK);
    REQUIRE(lit->step(0.005 * i, 0.005) == fmi3OK);
    for (const char* output : {"joint.paddle.position", "site.end.position.z", "site.end.axis.x"}) {
      CHECK(lit->real(output) == dark->real(output));
    }
  }
}

TEST_CASE("films and scenes whose intervals would never end are errors", "[mujoco_world]") {
  const char* const parameter = GENERATE("film.interval", "scene.interval");
  const ScratchFolder scratch;
  WorldUnit world(worlds::kTumble, scratch / "run");
  REQUIRE(world->set_real(parameter, 1e-12) == fmi3OK);
  CHECK(world->start_steps() != fmi3OK);
  CHECK(world.said(std::string(parameter) + ": ") == 1);
  CHECK(world.said("expected 0 for none, or at least 1e-6 s") == 1);
}

TEST_CASE("a scene goes on where a serialised state is restored", "[mujoco_world]") {
  const ScratchFolder scratch;
  const auto start = [](WorldUnit& world) {
    REQUIRE(world->set_real("scene.interval", 0.02) == fmi3OK);
    REQUIRE(world->start_steps() == fmi3OK);
    REQUIRE(world->step(0, 0.05) == fmi3OK);
  };
  WorldUnit whole(worlds::kTumble, scratch / "whole");
  start(whole);
  finish(whole);
  std::vector<fmi3Byte> bytes;
  {
    WorldUnit cut(worlds::kTumble, scratch / "cut");
    start(cut);
    bytes = serialized(cut.instance());
    REQUIRE(cut->step(0.05, 0.05) == fmi3OK);  // which is lost
  }
  const bool is_initialized = GENERATE(false, true);
  WorldUnit resumed(worlds::kTumble, scratch / "cut");
  if (is_initialized) {
    REQUIRE(resumed->set_real("scene.interval", 0.02) == fmi3OK);
    REQUIRE(resumed->start_steps() == fmi3OK);
  }
  REQUIRE(restore(resumed.instance(), bytes) == fmi3OK);
  CHECK(serialized(resumed.instance()) == bytes);
  finish(resumed);
  CHECK((film_files(scratch / "cut").at("world.glb") ==
         film_files(scratch / "whole").at("world.glb")));
  CHECK(film_files(scratch / "whole").size() == 1);  // without states there is nothing else
  CHECK(resumed.said("lacks the motion") == 0);
}

TEST_CASE("a state with a scene is restored where there is none, and the other way round",
          "[mujoco_world]") {
  const bool has_scene = GENERATE(false, true);
  const ScratchFolder scratch;
  WorldUnit with(worlds::kTumble, scratch / "with");
  WorldUnit without(worlds::kTumble, scratch / "without");
  REQUIRE(with->set_real("scene.interval", 0.02) == fmi3OK);
  for (WorldUnit* world : {&with, &without}) {
    REQUIRE((*world)->start_steps() == fmi3OK);
    REQUIRE((*world)->step(0, 0.05) == fmi3OK);
  }
  WorldUnit& from = has_scene ? with : without;
  WorldUnit& to = has_scene ? without : with;
  REQUIRE(restore(to.instance(), serialized(from.instance())) == fmi3OK);
  REQUIRE(to->step(0.05, 0.05) == fmi3OK);
  REQUIRE(to->fmi.Terminate(to->handle) == fmi3OK);
}

TEST_CASE("a scene cannot be where the results cannot be written", "[mujoco_world]") {
  const ScratchFolder scratch;
  std::ofstream(scratch / "run") << "no folder";
  WorldUnit world(worlds::kTumble, scratch / "run");
  REQUIRE(world->set_real("scene.interval", 0.02) == fmi3OK);
  CHECK(world->initialize() == fmi3Error);
  CHECK_THAT(world->last_message(), Contains("cannot") && Contains((scratch / "run").string()));
}

TEST_CASE("the start is set by parameters", "[mujoco_world]") {
  WorldUnit world(worlds::kBounce);
  REQUIRE(world.set_keyframe("high") == fmi3OK);
  REQUIRE(world->set_real("joint.gate.start", 0.25) == fmi3OK);
  REQUIRE(world->set_real("body.ball.start.position.x", 0.125) == fmi3OK);
  REQUIRE(world->initialize() == fmi3OK);
  CHECK(world->real("joint.gate.position") == 0.25);
  CHECK(world->real("site.centre.position.x") == 0.125);
  CHECK(world->real("site.centre.position.z") == 1);
}

TEST_CASE("a keyframe that is not there is an error with those that are", "[mujoco_world]") {
  WorldUnit world(worlds::kBounce);
  REQUIRE(world.set_keyframe("hihg") == fmi3OK);
  CHECK(world->initialize() == fmi3Error);
  CHECK_THAT(world->last_message(), Contains("'hihg'") && Contains("'high', 'open'"));
}

TEST_CASE("a flaw of the start is a warning, once", "[mujoco_world]") {
  WorldUnit world(worlds::kBounce);
  REQUIRE(world->set_real("body.ball.start.position.z", 0.04) == fmi3OK);
  REQUIRE(world->fmi.EnterInitializationMode(world->handle, false, 0, 0, false, 0) == fmi3OK);
  CHECK(world->real("site.centre.position.z") == 0.04);
  REQUIRE(world->set_real("actuator.gate", 0.1) == fmi3OK);  // which computes the start anew
  CHECK(world->real("site.centre.position.z") == 0.04);
  REQUIRE(world->fmi.ExitInitializationMode(world->handle) == fmi3OK);
  CHECK(world.said(" 10 mm inside of") == 1);
}

TEST_CASE("a keyframe's control that an input does not have is a warning", "[mujoco_world]") {
  WorldUnit world(worlds::kBounce);
  REQUIRE(world.set_keyframe("open") == fmi3OK);
  SECTION("where the input was left alone") {
    REQUIRE(world->start_steps() == fmi3OK);
    REQUIRE(world->step(0, 0.01) == fmi3OK);
    REQUIRE(world->step(0.01, 0.01) == fmi3OK);
    CHECK(world.said(
              "actuator 'gate' has its start value, 0.000000; the keyframe 'open' has 0.5") == 1);
  }
  SECTION("not where it was set") {
    REQUIRE(world->set_real("actuator.gate", -0.5) == fmi3OK);
    REQUIRE(world->start_steps() == fmi3OK);
    REQUIRE(world->step(0, 0.01) == fmi3OK);
    CHECK(world.said("actuator 'gate'") == 0);
  }
}

TEST_CASE("a step ends where a contact changes, if it may", "[mujoco_world]") {
  const bool may = GENERATE(true, false);
  WorldUnit world(worlds::kBounce, may);
  REQUIRE(world->start_steps() == fmi3OK);
  CHECK_FALSE(world.touches("floor"));
  REQUIRE(world->step(0, 0.2265) == fmi3OK);
  CHECK(world->last.early == may);
  CHECK(world->last.reached == (may ? 0.226 : 0.2265));
  CHECK(world.touches("floor"));
  CHECK(world.touches("any"));
  CHECK_FALSE(world->last.event);
}

TEST_CASE("a world without watched contacts has nothing to do with them", "[mujoco_world]") {
  WorldUnit with(worlds::kBounce);
  WorldUnit without(worlds::kTumble);
  CHECK_THAT(with.description(), Contains("mightReturnEarlyFromDoStep=\"true\""));
  CHECK_THAT(without.description(),
             !Contains("mightReturnEarlyFromDoStep=\"true\"") && !Contains("\"contact."));
}
