// What the unit player reads.
#include "tests/fuzz/parser.h"
#include "units/player/model.h"
#include "units/player/table.h"

namespace stride::tests {
namespace {

/// From end to end, in steps to where it leads.
void play(const player::Stimuli& stimuli) {
  player::Playback playback(stimuli);
  const auto check = [&](const player::Entry& entry) {
    const auto& input = stimuli.inputs.at(entry.input);
    const std::size_t size = std::visit([](const auto& list) { return list.size(); }, input.values);
    ensure(entry.kind != player::Entry::Kind::Value || entry.first + input.size <= size,
           "an entry has its values");
  };
  playback.begin(stimuli.start(), check);
  for (auto next = playback.following(); next; next = playback.following()) {
    playback.play_until(*next, check);
    while (playback.has_more(*next)) playback.iterate(*next, check);
  }
}

void read_stimuli(const std::string& bytes) {
  refusing<std::runtime_error>("x.csv:", [&] { play(player::parse_stimuli(bytes, "x.csv")); });
}

void read_table(const std::string& bytes) {
  refusing<std::runtime_error>("x.csv:", [&] { play(player::parse_table(bytes, "x.csv")); });
}

const Registration kPlayerParsers(
    "player", {
                  {.name = "stimuli",
                   .read = read_stimuli,
                   .seed_files = {"tests/fuzz/seeds/stimuli", "units/player/resources/stimuli.csv",
                                  "scenarios/replay_sensor/player/stimuli.csv"},
                   .alphabet = ",\"\n.0123456789-stepnd"},
                  {.name = "table",
                   .read = read_table,
                   .seed_files = {"tests/fuzz/seeds/table"},
                   .alphabet = ",\"\n\r;: []'.0123456789-+eTrueFalsInt"},
              });

}  // namespace
}  // namespace stride::tests
