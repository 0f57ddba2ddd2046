// What the unit player reads: damaged stimuli are read and played to their end, or refused with
// file and line.
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "tests/fuzz/mutator.h"
#include "tests/units/player/example.h"
#include "units/player/model.h"

using stride::tests::Mutator;

namespace {

/// From end to end, in steps to where it leads; returns how many entries were played.
std::size_t play(const player::Stimuli& stimuli) {
  player::Playback playback(stimuli);
  std::size_t played = 0;
  const auto count = [&](const player::Entry& entry) {
    const auto& values = stimuli.inputs.at(entry.input).values;
    const std::size_t size = std::visit([](const auto& list) { return list.size(); }, values);
    const bool is_value = entry.kind == player::Entry::Kind::Value;
    REQUIRE((!is_value || entry.first + stimuli.inputs[entry.input].size <= size));
    ++played;
  };
  playback.begin(stimuli.start(), count);
  for (auto next = playback.following(); next; next = playback.following()) {
    playback.come_to(*next, count);
    while (playback.has_more(*next)) playback.iterate(*next, count);
  }
  return played;
}

}  // namespace

TEST_CASE("mutated stimuli are played, or refused with file and line") {
  const std::string stimuli = stride::tests::example();
  REQUIRE(play(player::parse_stimuli(stimuli, "x.csv")) == 7);
  Mutator mutator(20240130, ",\"\n.0123456789-stepnd");
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    try {
      play(player::parse_stimuli(mutator.mutate(stimuli), "x.csv"));
      ++accepted;
    } catch (const std::runtime_error& error) {
      ++refused;
      CHECK(std::string(error.what()).rfind("x.csv:", 0) == 0);
    }
  }
  CHECK(accepted > 100);
  CHECK(refused > 1000);
}
