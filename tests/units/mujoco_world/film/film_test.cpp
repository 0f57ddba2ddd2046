#include "units/mujoco_world/film/film.h"

#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/scratch_folder.h"
#include "tests/units/mujoco_world/film/scene.h"
#include "tests/units/mujoco_world/states.h"

namespace fs = std::filesystem;
using mujoco_world::World;
using mujoco_world::film::Film;
using mujoco_world::film::FilmSettings;
using stride::Duration;
using stride::Time;

namespace {

using stride::tests::at;

const FilmSettings kEach30Ms{std::chrono::milliseconds(30), {64, 48, ""}};

/// By name, with their contents.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

using worlds::saved;

/// A world that tumbles, and its film.
struct Tumble {
  worlds::Folder folder{worlds::kTumble};
  World world{folder.path()};
  stride::tests::ScratchFolder scratch;
  Film film;

  explicit Tumble(const FilmSettings& settings = kEach30Ms)
      : film(world, settings, scratch / "film") {
    film.begin();
  }
  void advance(double to) { mujoco_world::advance(world, {&film}, at(to)); }
  std::map<std::string, std::string> files() const { return files_of(scratch / "film"); }
};

}  // namespace

TEST_CASE("pictures are of the multiples of the interval, from the beginning to the end") {
  if (scene::lacks_open_gl()) return;
  Tumble tumble;
  tumble.advance(0.0999);
  CHECK(tumble.files().at("frames.csv") ==
        "time,file\n0,00000.jpg\n0.03,00001.jpg\n0.06,00002.jpg\n0.09,00003.jpg\n");
  tumble.advance(0.12);
  CHECK(tumble.files().size() == 6);
  CHECK(tumble.files().at("00004.jpg") != tumble.files().at("00003.jpg"));
}

TEST_CASE("a film that begins between two of its instants waits for the next") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(worlds::kPendulum);
  World world(folder.path());
  const stride::tests::ScratchFolder scratch;
  for (const auto& [start, first] : {std::pair(0.01, "0.03"), std::pair(-0.01, "0")}) {
    world.reset(at(start));
    Film film(world, kEach30Ms, scratch / "film");
    advance(world, {&film}, at(0.05));
    CHECK(files_of(scratch / "film").at("frames.csv").find(first) == 10);
  }
}

TEST_CASE("a film does not depend on how time is cut into steps") {
  if (scene::lacks_open_gl()) return;
  Tumble whole;
  whole.advance(0.9);
  const auto expected = whole.files();
  REQUIRE(expected.size() == 32);
  const unsigned seed = GENERATE(1U, 2U, 3U);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> decades(8, 11);
  Tumble split;
  while (split.world.now() < at(0.9)) {
    const Duration step(std::llround(std::pow(10.0, decades(random))));
    advance(split.world, {&split.film}, std::min(at(0.9), split.world.now() + step));
  }
  CHECK(split.files() == expected);
}

TEST_CASE("a film does not show steps that were undone") {
  if (scene::lacks_open_gl()) return;
  Tumble straight;
  straight.advance(0.5);
  Tumble wandering;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> length(0.001, 0.1);
  while (wandering.world.now() < at(0.5)) {
    const double now = stride::to_seconds(wandering.world.now());
    const auto before = saved(wandering.world);
    const auto pictures = wandering.film.pictures();
    wandering.world.set_input(0, 2);  // another way than the one that counts
    wandering.advance(now + length(random));
    wandering.world.restore(before.data());
    wandering.film.go_on(pictures);
    wandering.world.set_input(0, 0);
    wandering.advance(std::min(0.5, now + length(random)));
  }
  CHECK(wandering.files() == straight.files());
}

TEST_CASE("what was undone is gone at once") {
  if (scene::lacks_open_gl()) return;
  Tumble tumble;
  tumble.advance(0.06);
  const auto before = tumble.files();
  const auto state = saved(tumble.world);
  const auto pictures = tumble.film.pictures();
  CHECK(pictures == 3);
  tumble.advance(0.3);
  CHECK(tumble.files().size() == before.size() + 8);
  tumble.world.restore(state.data());
  CHECK(tumble.film.go_on(pictures));
  CHECK(tumble.files() == before);
}

TEST_CASE("a film goes on in another world that gets its state, from the files that are there") {
  if (scene::lacks_open_gl()) return;
  Tumble whole;
  whole.advance(0.9);
  const double cut = GENERATE(0.0, 0.3, 0.3141);
  Tumble first;
  first.advance(cut);
  const auto state = saved(first.world);
  const auto pictures = first.film.pictures();
  first.advance(0.7);  // which is not known to have happened

  World world(first.folder.path());
  Film film(world, kEach30Ms, first.scratch / "film");
  CHECK(film.pictures() == std::nullopt);
  world.restore(state.data());
  CHECK(film.go_on(pictures));
  CHECK(film.pictures() == pictures);
  advance(world, {&film}, at(0.9));
  CHECK(files_of(first.scratch / "film") == whole.files());
}

TEST_CASE("a film whose files are not there goes on, and says so") {
  if (scene::lacks_open_gl()) return;
  Tumble first;
  first.advance(0.2);
  fs::remove(first.scratch / "film/00002.jpg");
  World world(first.folder.path());
  Film film(world, kEach30Ms, first.scratch / "film");
  const auto state = saved(first.world);
  world.restore(state.data());
  CHECK_FALSE(film.go_on(first.film.pictures()));
  advance(world, {&film}, at(0.22));
  CHECK(files_of(first.scratch / "film").at("frames.csv") ==
        "time,file\n0,00000.jpg\n0.03,00001.jpg\n0.21,00002.jpg\n");
}

TEST_CASE("a film that has not begun leaves the one that is there, until it begins") {
  if (scene::lacks_open_gl()) return;
  Tumble first;
  first.advance(0.2);
  const auto before = first.files();
  World world(first.folder.path());
  {
    Film film(world, kEach30Ms, first.scratch / "film");
    CHECK(film.go_on(std::nullopt));
  }
  CHECK(first.files() == before);
  Film film(world, kEach30Ms, first.scratch / "film");
  advance(world, {&film}, at(0.01));
  CHECK(first.files().size() == 2);
}

TEST_CASE("a film begins anew with its world") {
  if (scene::lacks_open_gl()) return;
  Tumble tumble;
  const auto beginning = tumble.files();
  tumble.advance(0.2);
  const auto first = tumble.files();
  tumble.world.reset(Time{});
  tumble.film.go_on(1);
  CHECK(tumble.files() == beginning);
  tumble.advance(0.2);
  CHECK(tumble.files() == first);
}

TEST_CASE("a film needs an interval") {
  CHECK_THROWS_AS(Tumble({Duration{}, {}}), std::invalid_argument);
  CHECK_THROWS_AS(Tumble({Duration(-1), {}}), std::invalid_argument);
}

TEST_CASE("a film of a world that stops at contacts lacks no picture") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(worlds::kBounce);
  const FilmSettings each_1_ms{std::chrono::milliseconds(1), {64, 48, ""}};
  std::map<std::string, std::string> files[2];
  for (const bool stops : {false, true}) {
    const stride::tests::ScratchFolder scratch;
    World world(folder.path());
    Film film(world, each_1_ms, scratch / "film");
    int times_stopped = 0;
    while (world.now() < at(0.3)) times_stopped += advance(world, {&film}, at(0.3), stops) ? 1 : 0;
    CHECK((times_stopped > 1) == stops);
    files[stops] = files_of(scratch / "film");
  }
  CHECK(files[0] == files[1]);
}
