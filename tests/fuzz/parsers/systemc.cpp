// What the player for testbenches of SystemC reads.
#define SC_DISABLE_API_VERSION_CHECK  // that is for C++17, and nothing is simulated here
#include <optional>

#include <stride/systemc/stimuli_player.h>

#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"
#include "units/player/stimuli.h"

namespace stride::tests {
namespace {

bool is_good_for_unit(const std::string& bytes) {
  try {
    player::parse_stimuli(bytes, "x.csv");
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Most inputs are of another type, which is no mistake of the file.
template <class T>
void take(systemc::StimuliPlayer& player, const std::string& name) {
  try {
    player.on_message(name, [](const T&) {});
  } catch (const std::runtime_error&) {
  }
}

void read_for_testbench(const std::string& bytes) {
  const std::string file = write_file("x.csv", bytes).string();
  std::optional<systemc::StimuliPlayer> player;
  const bool is_good = is_good_for_unit(bytes);
  refusing<std::runtime_error>(file, [&] {
    try {
      player.emplace(file);
    } catch (const std::runtime_error& mistake) {
      ensure(!is_good, std::string("the unit player takes it: ") + mistake.what());
      throw;
    }
  });
  for (const char* name : {"level", "mode", "message.text", "flags[2,1]", "other"}) {
    take<double>(*player, name);
    take<int>(*player, name);
    take<bool>(*player, name);
    take<std::string>(*player, name);
    take<systemc::StimuliPlayer::Bytes>(*player, name);
  }
}

const Registration kSystemcParsers("systemc",
                                   {
                                       {.name = "testbench_stimuli",
                                        .read = read_for_testbench,
                                        .seed_files = {"tests/fuzz/seeds/stimuli",
                                                       "units/player/resources/stimuli.csv"},
                                        .alphabet = ",\"\n.0123456789-stepnd"},
                                   });

}  // namespace
}  // namespace stride::tests
