// An arm of another origin brings the reader to our sensor. There are no golden results: the last
// digits of a collision geometry that others may change are not ours to promise.
#include <iostream>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

/// ur5e_world_test.sh packs it, where the arm can be fetched.
bool has_world() {
  if (fs::exists(unit_folder() / "ur5e_world.fmu")) return true;
  std::cout << "SKIPPED: there is no ur5e_world.fmu\n";
  return false;
}

const ScenarioRun& whole() {
  static const ScenarioRun only("ur5e_approach", {"--no-trace", "--no-idle-skip"});
  return only;
}

const ScenarioRun& skipping() {
  static const ScenarioRun only("ur5e_approach", {"--no-trace"});
  return only;
}

}  // namespace

TEST_CASE("ur5e_approach: the arm reaches each pose, and from 2.5 cm the sensor answers") {
  if (!has_world()) return;
  const ScenarioRun& run = whole();
  const auto distance_at = [&](const char* time) { return run.at(time, "channel.distance [m]"); };
  CHECK(distance_at("0") == Approx(0.4).margin(1e-3));
  CHECK(distance_at("2.9") == Approx(0.2).margin(2e-4));
  CHECK(distance_at("8") == Approx(0.025).margin(2e-4));
  CHECK(run.between("0", "8", "channel.distance [m]").least > 0.024);

  CHECK(run.payloads("reader", "report.text", "sent") ==
        std::vector<std::string>{
            "at 2.6 s identify: expected no answer; got no answer after 1 try",
            "at 7 s read_temperature: expected ok 21 to 22 degC; got ok 21.49 degC after 1 try",
            "at 7.5 s identify: expected ok identifier 0x53454E53; got ok identifier 0x53454E53 "
            "after 1 try"});
  CHECK(run.at("8", "reader.messages.as_expected") == 3);
}

TEST_CASE("ur5e_approach: each run has the same bytes, also with several threads") {
  if (!has_world()) return;
  const ScenarioRun again("ur5e_approach", {"--no-trace"});
  const ScenarioRun parallel("ur5e_approach", {"--no-trace", "--threads", "3"});
  for (const char* file : {"signals.csv", "events.csv"}) {
    INFO(file);
    const std::string expected = text_of(skipping().file(file));
    CHECK(expected.size() > 100);
    CHECK(text_of(again.file(file)) == expected);
    CHECK(text_of(parallel.file(file)) == expected);
  }
}

TEST_CASE("ur5e_approach: idle skipping changes no message, and distances within the tolerance") {
  if (!has_world()) return;
  CHECK(text_of(skipping().file("events.csv")) == text_of(whole().file("events.csv")));
  for (const char* time : {"2.9", "5", "8"}) {
    CHECK(skipping().at(time, "channel.distance [m]") ==
          Approx(whole().at(time, "channel.distance [m]")).margin(5e-4));
  }
}
