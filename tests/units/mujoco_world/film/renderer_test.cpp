#include "units/mujoco_world/film/renderer.h"

#include <algorithm>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/units/mujoco_world/film/scene.h"

using Catch::Matchers::Contains;
using mujoco_world::World;
using mujoco_world::film::Picture;
using mujoco_world::film::Renderer;
using mujoco_world::film::View;
using scene::patch;

namespace {

constexpr std::size_t kRed = 0;
constexpr std::size_t kBlue = 2;

using stride::tests::at;

Picture picture(const World& world, const View& view) {
  return Renderer(world.model(), view).draw(world.model(), world.drawn());
}

/// Turns round and round, and so is never seen twice alike.
Picture turned(double seconds) {
  const worlds::Folder folder(worlds::kTumble);
  World world(folder.path());
  Renderer renderer(world.model(), {64, 48, ""});
  Picture last;
  for (int i = 1; i <= 20; ++i) {
    world.advance(at(seconds * i / 20));
    last = renderer.draw(world.model(), world.drawn());
  }
  return last;
}

}  // namespace

TEST_CASE("what is red and in the middle is red in the middle of the picture") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  const World world(folder.path());
  const Picture seen = picture(world, {160, 120, "front"});
  REQUIRE(seen.rgb.size() == 160 * 120 * 3);
  // 0.4 m wide at a distance of 1.8 m; the height of the picture is 45 degrees
  const double side = 120 * 0.4 / (2 * 1.8 * std::tan(0.5 * 45 * M_PI / 180));
  const scene::Patch red = patch(seen, kRed);
  CHECK(static_cast<double>(red.count) == Approx(side * side).epsilon(0.05));
  CHECK(red.column == Approx(79.5).margin(0.6));
  CHECK(red.row == Approx(59.5).margin(0.6));
}

TEST_CASE("a lamp shines in the dark") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(worlds::kLamp);
  World world(folder.path());
  Renderer renderer(world.model(), {160, 120, ""});
  const auto red = [&] {
    return patch(renderer.draw(world.model(), world.drawn(), world.display()), kRed).count;
  };
  CHECK(red() == 0);
  world.set_lamp(0, true);
  CHECK(red() > 100);
  world.set_lamp(0, false);
  CHECK(red() == 0);
}

TEST_CASE("a lamp of a dark colour shines in its hue, and has a halo") {
  if (scene::lacks_open_gl()) return;
  std::string daylight = worlds::kLamp;
  daylight.replace(daylight.find("0.1 0.1 0.1"), 11, "1 1 1");
  const worlds::Folder bright(daylight);
  const std::size_t ball = patch(picture(World(bright.path()), {160, 120, ""}), kRed).count / 2;

  std::string dark = worlds::kLamp;
  dark.replace(dark.find("1 0 0 1"), 7, "0.1 0 0 1");
  const worlds::Folder folder(dark);
  const World world(folder.path());
  Renderer renderer(world.model(), {160, 120, ""});
  const int led = world.catalogue().lamps[0].geom;
  const Picture off = renderer.draw(world.model(), world.drawn());
  const Picture on = renderer.draw(world.model(), world.drawn(), {{led}, {}});
  std::size_t pure = 0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < on.rgb.size(); i += 3) {
    pure += on.rgb[i] == 255 ? 1 : 0;
    changed += on.rgb[i] != off.rgb[i] ? 1 : 0;
  }
  CHECK(patch(off, kRed).count == 0);
  CHECK(static_cast<double>(pure) == Approx(static_cast<double>(ball)).epsilon(0.3));
  CHECK(changed > 4 * ball);
}

TEST_CASE("a field is an ellipsoid about the axis of its site, which is seen through") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(worlds::kField);
  World world(folder.path());
  Renderer renderer(world.model(), {160, 120, "film"});
  const auto drawn = [&] { return renderer.draw(world.model(), world.drawn(), world.display()); };
  const Picture without = drawn();
  CHECK(patch(without, kRed).count == 0);
  world.set_field(0, 0.3);
  const Picture with = drawn();
  std::size_t changed = 0;
  std::size_t first = 160, last = 0;  // columns
  for (std::size_t i = 0; i < with.rgb.size(); i += 3) {
    if (std::equal(&with.rgb[i], &with.rgb[i] + 3, &without.rgb[i])) continue;
    ++changed;
    first = std::min(first, i / 3 % 160);
    last = std::max(last, i / 3 % 160);
  }
  // the camera is 3 m away, and its picture 45 degrees high; the axis is horizontal in it
  const double reach = 0.3 * 120 / (2 * 3 * std::tan(0.5 * 45 * M_PI / 180));
  CHECK(static_cast<double>(last - first + 1) == Approx(2 * reach).epsilon(0.06));
  CHECK(static_cast<double>(changed) ==
        Approx(M_PI * mujoco_world::kFieldWidth * reach * reach).epsilon(0.06));
  CHECK(patch(with, kRed).count == 0);  // not opaque
  world.set_field(0, 0);
  CHECK(drawn().rgb == without.rgb);
}

TEST_CASE("what is nearer hides what is behind it") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  const World world(folder.path());
  CHECK(patch(picture(world, {160, 120, "front"}), kBlue).count == 0);
  const Picture from_behind = picture(world, {160, 120, "back"});
  CHECK(patch(from_behind, kBlue).count > 200);
  CHECK(patch(from_behind, kRed).count > 0);
}

TEST_CASE("what moves to the right does so in the picture, by as much") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  World world(folder.path());
  Renderer renderer(world.model(), {160, 120, "front"});
  const double before = patch(renderer.draw(world.model(), world.drawn()), kRed).column;
  world.set_input(0, 0.5);
  world.advance(at(3));
  const scene::Patch after = patch(renderer.draw(world.model(), world.drawn()), kRed);
  const double pixels = 120 * world.joint_position(0) / (2 * 1.8 * std::tan(M_PI / 8));
  REQUIRE(world.joint_position(0) > 0.4);
  // of the box's side that is seen now, too, the middle is nearer to that of the picture
  CHECK(after.column - before == Approx(pixels).epsilon(0.15));
  CHECK(after.row == Approx(59.5).margin(0.6));
  CHECK(patch(renderer.draw(world.model(), world.drawn()), kBlue).count > 100);
}

TEST_CASE("what is at rest looks the same, what moves does not") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  World world(folder.path());
  Renderer renderer(world.model(), {160, 120, "front"});
  const auto seen = [&] { return renderer.draw(world.model(), world.drawn()).rgb; };
  const auto first = seen();
  world.advance(at(1));
  CHECK(seen() == first);
  world.set_input(0, 0.5);
  world.advance(at(2));
  const auto moved = seen();
  CHECK(moved != first);
  CHECK(seen() == moved);
  world.reset(at(0));
  CHECK(seen() == first);
}

TEST_CASE("what is above is in the upper rows") {
  if (scene::lacks_open_gl()) return;
  std::string raised = scene::kBoxes;
  raised.insert(raised.find("name=\"red\"") + 10, " pos=\"0 0 0.4\"");
  const worlds::Folder folder(raised);
  const World world(folder.path());
  CHECK(patch(picture(world, {160, 120, "front"}), kRed).row < 45);
}

TEST_CASE("without a camera the whole world is seen, unless the model has one called film") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  const World world(folder.path());
  const scene::Patch whole = patch(picture(world, {160, 120, ""}), kRed);
  CHECK(whole.count > 100);
  CHECK(whole.count < 160 * 120 / 2);

  std::string named = scene::kBoxes;
  named.replace(named.find("\"back\""), 6, "\"film\"");
  const worlds::Folder with_film(named);
  const World other(with_film.path());
  CHECK(picture(other, {160, 120, ""}).rgb == picture(world, {160, 120, "back"}).rgb);
}

TEST_CASE("a camera that is not there is an error that lists those that are") {
  const worlds::Folder folder(scene::kBoxes);
  const World world(folder.path());
  CHECK_THROWS_WITH(Renderer(world.model(), {160, 120, "side"}),
                    "film.camera: the world has no camera 'side'; its cameras are: 'front', "
                    "'back'");
  const worlds::Folder pendulum(worlds::kPendulum);
  const World without(pendulum.path());
  CHECK_THROWS_WITH(Renderer(without.model(), {160, 120, "side"}),
                    Contains("its cameras are: none; leave it empty"));
}

TEST_CASE("a picture may be as small or as large as a film's may be") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(scene::kBoxes);
  const World world(folder.path());
  for (const auto& [width, height] : {std::pair(16, 16), std::pair(4096, 16), std::pair(17, 801)}) {
    const Picture seen = picture(world, {width, height, "front"});
    CHECK(seen.rgb.size() == static_cast<std::size_t>(3 * width * height));
    CHECK(patch(seen, kRed).count > 0);
  }
}

TEST_CASE("to draw a world does not move it") {
  if (scene::lacks_open_gl()) return;
  const worlds::Folder folder(worlds::kTumble);
  World drawn(folder.path());
  World unseen(folder.path());
  Renderer renderer(drawn.model(), {32, 24, ""});
  for (int i = 1; i <= 30; ++i) {
    drawn.advance(at(i * 0.0333));
    renderer.draw(drawn.model(), drawn.drawn());
    unseen.advance(at(i * 0.0333));
  }
  std::vector<double> blocks[2];
  for (const World* world : {&drawn, &unseen}) {
    auto& block = blocks[world == &drawn];
    block.resize(world->state_size());
    world->save(block.data());
  }
  CHECK(blocks[0] == blocks[1]);
  CHECK(drawn.site_position(0) == unseen.site_position(0));
}

TEST_CASE("worlds are drawn in several threads as in one") {
  if (scene::lacks_open_gl()) return;
  const double ends[] = {0.2, 0.3, 0.4, 0.5};
  std::vector<Picture> together(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] { together[i] = turned(ends[i]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(together[i].rgb == turned(ends[i]).rgb);
    CHECK(together[i].rgb != together[(i + 1) % 4].rgb);
  }
}
