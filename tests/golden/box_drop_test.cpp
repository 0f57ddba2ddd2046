// box_drop: what its tutorial, docs/accelerometer.md, relies on.
#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"

using namespace stride::tests;

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

TEST_CASE("box_drop: it begins where its parameters say") {
  const ScenarioRun low("box_drop", {"--no-trace", "--set", "world.body.box.start.position.z=0.035",
                                     "--stop", "0.2"});
  CHECK(low.at("0", "world.site.chip.position.z [m]") == Approx(0.045));
  CHECK(low.at("0.2", "firmware.peak [m/s2]") == Approx(70.93).epsilon(0.001));

  const ScenarioRun corner("box_drop",
                           {"--no-trace", "--set", "world.start.keyframe=on_its_corner"});
  CHECK(corner.at("1", "firmware.shocks") > 2);  // as many as it has when it falls flat
}
