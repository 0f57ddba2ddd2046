// A regression suite of the flagship's sensor, from a campaign of the flagship.
#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

/// The reader where it should be twice, and beside that place.
std::string campaign() {
  return "<OpenSCENARIO><FileHeader revMajor='1' revMinor='1' date='2026-01-01T00:00:00' author=''"
         " description=''/><ParameterValueDistribution><ScenarioFile filepath='" +
         (scenario_folder("nfc_approach") / "nfc_approach.ssd").string() +
         "'/><Deterministic><DeterministicSingleParameterDistribution "
         "parameterName='reader.waypoint_offset.wrist_2'><DistributionSet><Element value='0'/>"
         "<Element value='0.001'/><Element value='0.4'/></DistributionSet>"
         "</DeterministicSingleParameterDistribution></Deterministic></ParameterValueDistribution>"
         "<stride:Campaign xmlns:stride='urn:org.stride:campaign:1'><stride:Keep results='all'/>"
         "<stride:Capture component='sensor'/></stride:Campaign></OpenSCENARIO>";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
  return found;
}

}  // namespace

TEST_CASE("the sensor of nfc_approach has a suite that needs neither MuJoCo nor a robot") {
  const ScratchFolder folder;
  std::ofstream(folder / "c.xosc") << campaign();
  const std::string cases = (folder / "cases").string(), suite = (folder / "suite").string();
  const Outcome run =
      run_program({"campaign", "run", (folder / "c.xosc").string(), "-q", "--out", cases});
  INFO(run.err);
  REQUIRE(run.exit_code == 1);
  const Outcome outcome =
      run_program({"campaign", "distil", cases, "--component", "sensor", "--out", suite});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  fs::remove_all(cases);
  std::size_t replays = 0, results = 0;
  for (const auto& entry : fs::directory_iterator(suite)) {
    if (entry.path().extension() != ".ssd") continue;
    ++replays;
    const std::string text = text_of(entry.path());
    CHECK(count(text, "<ssd:Component ") == 2);
    CHECK(count(text, " source=\"sensor.fmu\"") == 1);
    CHECK(count(text, " source=\"stimuli_" + entry.path().stem().string() + ".fmu\"") == 1);
    CHECK(count(text, "event=\"sensor.transmit.frame\" equals=\"") == 1);
    const std::string out = (folder / "out").string();
    const Outcome replay = run_program({"run", entry.path().string(), "-q", "--out", out});
    INFO(replay.err);
    CHECK(replay.exit_code == 0);
    const fs::path golden = fs::path(suite) / "golden" / entry.path().stem();
    for (const char* file : {"signals.csv", "events.csv"}) {
      ++results;
      CHECK((text_of(golden / file) == text_of(fs::path(out) / file)));
    }
  }
  CHECK(replays == 2);
  CHECK(results == 4);
}
