// The sensor's traces, with and without idle skipping.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "tests/build.h"
#include "tests/units/sensor/simulated_sensor.h"
#include "tests/units/systemc/vcd.h"

using stride::Duration;
using stride::tests::read_vcd;
using stride::tests::Vcd;

namespace fs = std::filesystem;

namespace {

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("stride_sensor_" + std::to_string(getpid()));
  TemporaryFolder() { fs::create_directory(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

void expand(const std::string& from, const std::string& to) {
  const std::string command = stride::tests::stride_program().string() + " trace expand " + from +
                              " " + to + " > /dev/null";
  REQUIRE(std::system(command.c_str()) == 0);
}

}  // namespace

TEST_CASE("an expanded trace is the one without skipping, but for the edges of a free clock") {
  const TemporaryFolder folder;
  const auto trace = [&](bool gating, bool skips) {
    const std::string file = folder / "sensor.vcd";
    sensor::simulate(
        sensor::SensorSettings{gating, skips ? std::optional(Duration::max()) : std::nullopt, file,
                               2e5},
        3);
    return read_vcd(file);
  };
  for (const bool gating : {true, false}) {
    const Vcd full = trace(gating, false);
    const Vcd skipping = trace(gating, true);
    CHECK(full.signals.size() == 17);
    for (const auto& [name, changes] : full.signals) {
      CAPTURE(gating, name);
      const Vcd::Changes& found = skipping.of(name);
      if (name == "advanceTime") {
        CHECK(found.size() > 10);
      } else if (name == "sensor.clock" && !gating) {
        CHECK(std::includes(changes.begin(), changes.end(), found.begin(), found.end()));
        CHECK(found.size() < changes.size() / 5);
      } else {
        CHECK(found == changes);
      }
    }
    CHECK(full.of("sensor.DataUCToTrm").size() > 3);
    expand(folder / "sensor.vcd", folder / "expanded.vcd");
    Vcd by_program = read_vcd(folder / "expanded.vcd");
    Vcd by_convention = skipping;
    by_convention.signals.erase("advanceTime");
    CHECK(by_program.signals == by_convention.signals);
    CHECK(skipping.last_stamp < full.last_stamp / 5);
  }
}
