// box_drop: what its tutorial, docs/accelerometer.md, relies on.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// The first instant at which a flag is raised [s].
double first_time(const ScenarioRun& run, const std::string& flag) {
  const Csv& signals = run.signals();
  const std::size_t column = signals.column(flag);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals.number(i, column) == 1) return signals.number(i, 0);
  }
  throw std::runtime_error(flag + " is never true");
}

}  // namespace

TEST_CASE("box_drop: as ever, with and without skipping") {
  const ScenarioRun run("box_drop", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("box_drop", run) == "");
  const ScenarioRun skipping("box_drop", {"--no-trace"});
  CHECK(skipping.payloads("firmware", "shock.samples", "received") ==
        run.payloads("firmware", "shock.samples", "received"));
}

TEST_CASE("box_drop: the contact, the interrupt and its record come when they have to") {
  const ScenarioRun run("box_drop", {"--no-trace"});
  const double landing = first_time(run, "world.contact.landing");
  const double falls_for = std::sqrt(2 * 0.04 / 9.81);
  CHECK(landing >= falls_for);
  CHECK(landing < falls_for + 0.0005);  // the world's timestep

  // a sample each millisecond, the first one 9 us after the first communication point
  const double interrupt = first_time(run, "accelerometer.irq");
  CHECK(interrupt == Approx(std::ceil(landing * 1000) / 1000 + 9e-6).epsilon(1e-12));
  CHECK(first_time(run, "firmware.awake") == interrupt);
  const auto records = run.instants("firmware", "shock.samples", "received");
  REQUIRE(!records.empty());
  CHECK(std::stod(records.front()) == Approx(interrupt + 0.024).epsilon(1e-12));
}

namespace {

/// "TIME irq 0" and "TIME shock SAMPLE …", as the testbench prints them.
std::string said_by_testbench(const fs::path& stimuli) {
  Process process({ACCELEROMETER_TESTBENCH, stimuli.string()}, stimuli.parent_path());
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  return outcome.out;
}

/// Likewise, of the run: two bytes of hexadecimal digits each, the high one first.
std::string shock_line(const std::string& time, const std::string& payload) {
  std::string line = fmt::format("{:.6f} shock", std::stod(time));
  for (std::size_t at = 0; at < payload.size(); at += 4) {
    const auto sample = static_cast<std::int16_t>(std::stoi(payload.substr(at, 4), nullptr, 16));
    line += fmt::format(" {}", sample);
  }
  return line + "\n";
}

}  // namespace

TEST_CASE("box_drop: the chip alone, with SystemC and its stimuli, does what it did") {
  const ScratchFolder folder;
  const fs::path stimuli = folder / "chip.csv";
  const ScenarioRun run("box_drop", {"--no-trace", "--no-idle-skip", "--capture",
                                     "accelerometer=" + stimuli.string()});
  const auto times = run.instants("accelerometer", "shock.samples", "sent");
  const auto payloads = run.payloads("accelerometer", "shock.samples", "sent");
  REQUIRE(times.size() == 2);
  const std::string said = said_by_testbench(stimuli);
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK_THAT(said, Contains(shock_line(times[i], payloads[i])));
  }
  const std::string irq = fmt::format("{:.6f} irq 1\n", first_time(run, "accelerometer.irq"));
  CHECK_THAT(said, Contains(irq));
  CHECK(std::count(said.begin(), said.end(), '\n') == 6);
}

TEST_CASE("box_drop: it begins where its parameters say") {
  const ScenarioRun low("box_drop", {"--no-trace", "--set", "world.body.box.start.position.z=0.035",
                                     "--stop", "0.2"});
  CHECK(low.at("0", "world.site.chip.position.z [m]") == Approx(0.045));
  CHECK(low.at("0.2", "firmware.peak [m/s2]") == Approx(70.93).epsilon(0.001));

  const ScenarioRun corner("box_drop",
                           {"--no-trace", "--set", "world.start.keyframe=on_its_corner"});
  CHECK(corner.at("1", "firmware.shocks") > 2);  // as many as it has when it falls flat
}
