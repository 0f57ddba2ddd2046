#include "units/player/model.h"

#include <functional>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/units/player/example.h"

using namespace player;
using stride::Time;
using stride::time_from_seconds;

namespace {

/// Plays the example, and says what was played: names, and "tick" for ticks.
class Player {
 public:
  explicit Player(const std::string& text)
      : stimuli_(parse_stimuli(text, "x")), playback(stimuli_) {}

  std::string begin(double time) {
    playback.begin(time_from_seconds(time), note());
    return take();
  }
  std::string play_until(double time) {
    moved = playback.play_until(time_from_seconds(time), note());
    return take();
  }
  std::string iterate(double time) {
    playback.iterate(time_from_seconds(time), note());
    return take();
  }

 private:
  std::function<void(const Entry&)> note() {
    return [this](const Entry& entry) {
      const bool is_tick = entry.kind == Entry::Kind::Tick;
      played_ +=
          (played_.empty() ? "" : " ") + (is_tick ? "tick" : stimuli_.inputs[entry.input].name);
    };
  }
  std::string take() { return std::exchange(played_, ""); }

  Stimuli stimuli_;
  std::string played_;

 public:
  Playback playback;
  bool moved = false;
};

}  // namespace

TEST_CASE("entries come at their instants and in their iterations") {
  Player player(stride::tests::example());
  CHECK(player.begin(0) == "level mode flags");
  CHECK(player.iterate(0) == "");
  CHECK(player.playback.target() == time_from_seconds(0.25));
  CHECK(player.play_until(0.25) == "level");
  CHECK(player.moved);
  // a step that ended where it began is passed with what led to it
  CHECK(player.playback.target() == time_from_seconds(0.5));
  CHECK(player.playback.following() == time_from_seconds(0.499999999999));
  CHECK(player.play_until(0.499999999999) == "mode");
  CHECK(player.playback.has_more(time_from_seconds(0.499999999999)));
  CHECK(player.iterate(0.499999999999) == "tick message.text");
  CHECK(!player.playback.has_more(time_from_seconds(0.499999999999)));
  CHECK(player.playback.target() == time_from_seconds(1));
  CHECK(player.play_until(1) == "");
  CHECK(player.moved);
  CHECK(!player.playback.target());
  CHECK(!player.playback.following());
  CHECK(player.play_until(2) == "");
  CHECK(!player.moved);
}

TEST_CASE("points between the captured ones are noted, and change nothing") {
  Player player(stride::tests::example());
  player.begin(0);
  CHECK(player.play_until(0.1) == "");
  CHECK(!player.moved);
  CHECK(player.playback.position().beside == time_from_seconds(0.1));
  CHECK(player.playback.target() == time_from_seconds(0.25));
  CHECK(player.play_until(0.25) == "level");
  CHECK(player.playback.position().late == -1);
}

TEST_CASE("what is late is played at once and in order, and noted") {
  Player player(stride::tests::example());
  player.begin(0);
  CHECK(player.play_until(0.75) == "level mode tick message.text");
  CHECK(player.playback.position().late == 4);
  CHECK(player.playback.target() == time_from_seconds(1));
}

TEST_CASE("a clock that is late twice ticks in two iterations") {
  Player player(stride::tests::replaced(
      stride::tests::example(), "0.499999999999,step,,1\n",
      "0.499999999999,step,,0.6\n0.6,1,message.clock,\n0.6,1,message.text,\"d\"\n0.6,step,,1\n"));
  player.begin(0);
  CHECK(player.play_until(1) == "level mode tick message.text");
  CHECK(player.playback.has_more(time_from_seconds(1)));
  CHECK(player.iterate(1) == "tick message.text");
  CHECK(!player.playback.has_more(time_from_seconds(1)));
}

TEST_CASE("a position is all that there is to keep") {
  Player player(stride::tests::example());
  player.begin(0);
  const Playback::Position before = player.playback.position();
  CHECK(player.play_until(0.75) != "");
  player.playback.position() = before;
  CHECK(player.play_until(0.25) == "level");
}

TEST_CASE("a run may begin in the midst: values are there, ticks have gone") {
  Player player(stride::tests::example());
  CHECK(player.begin(0.7) == "level mode flags level mode message.text");
  CHECK(player.playback.target() == time_from_seconds(1));
  CHECK(player.begin(0.499999999999) == "level mode flags level mode");
  CHECK(player.iterate(0.499999999999) == "tick message.text");
}
