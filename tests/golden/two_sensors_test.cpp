// Two SystemC sensors that may both stop early, in nfc_two_tags: one of them is taken back by
// snapshots of its process, which changes nothing but when frames are handed over, now exactly.
#include <cstdint>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSensors = {"sensor_left", "sensor_right"};
// by then both have answered, also at the same instant, and the right one alone
const Arguments kSensorsStop{"--no-trace", "--stop", "3.8"};

/// nfc_two_tags with another text in the place of its EarlyReturn.
class Variant {
 public:
  explicit Variant(const std::string& text) {
    const std::string before =
        "<stride:EarlyReturn components=\"sensor_right\" allowed=\"false\"/>";
    std::string scenario = text_of(scenario_folder("nfc_two_tags") / "nfc_two_tags.ssd");
    scenario.replace(scenario.find(before), before.size(), text);
    std::ofstream(file()) << scenario;
    fs::copy_file(scenario_folder("nfc_two_tags") / "sensors.ssv", folder_ / "sensors.ssv");
  }

  std::string file() const { return (folder_ / "variant.ssd").string(); }
  fs::path trace(const std::string& sensor) const { return folder_ / (sensor + ".vcd"); }

  /// With the inner signals of both sensors in trace().
  ScenarioRun traced_run() const {
    Arguments arguments = kSensorsStop;
    // the traces are beside the scenario, and steps can be long where what happens in them is exact
    arguments.insert(arguments.end(), {"--no-sandbox", "--step", "0.01"});
    for (const std::string& sensor : kSensors) {
      arguments.push_back("--set");
      arguments.push_back(sensor + ".trace.file=" + trace(sensor).string());
    }
    return ScenarioRun(file(), arguments);
  }

 private:
  ScratchFolder folder_;
};

/// Both may return early.
const ScenarioRun& exact_run() {
  static const ScenarioRun only(Variant("").file(), kSensorsStop);
  return only;
}

/// What run.json contains about a component.
nlohmann::json unit_entry(const ScenarioRun& run, const std::string& component) {
  const auto told = nlohmann::json::parse(text_of(run.file("run.json")));
  for (const auto& unit : told["units"]) {
    if (unit["name"] == component) return unit;
  }
  throw std::out_of_range(component);
}

/// The instant at which a frame begins, which is in its first eight bytes, as events.csv writes
/// instants.
std::string beginning(const std::string& frame) {
  std::uint64_t picoseconds = 0;
  for (std::size_t byte = 8; byte-- > 0;) {
    picoseconds = picoseconds << 8 | std::stoul(frame.substr(2 * byte, 2), nullptr, 16);
  }
  std::string text = std::to_string(picoseconds);
  text.insert(0, text.size() <= 12 ? 13 - text.size() : 0, '0');
  text.insert(text.size() - 12, ".");
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Without the lines that have the date of the file.
std::string signals_of(const fs::path& vcd) {
  const std::string text = text_of(vcd);
  return text.substr(text.find("$version"));
}

}  // namespace

TEST_CASE("each frame of both sensors is handed over at the picosecond at which it begins") {
  const ScenarioRun& run = exact_run();
  for (const std::string& sensor : kSensors) {
    INFO(sensor);
    CHECK(unit_entry(run, sensor)["early_returns"] > 0);
    const auto frames = run.payloads(sensor, "transmit.frame", "sent");
    const auto instants = run.instants(sensor, "transmit.frame", "sent");
    REQUIRE(frames.size() == 5);
    for (std::size_t i = 0; i < frames.size(); ++i) CHECK(instants[i] == beginning(frames[i]));
  }
  CHECK_FALSE(unit_entry(run, "sensor_left").contains("host"));
  const auto snapshots = unit_entry(run, "sensor_right").at("host").at("snapshots");
  CHECK(snapshots.at("made") > 10);
  CHECK(snapshots.at("most_kept") == 1);
}

TEST_CASE(
    "the frames, and the instants of the units for which they are exact, are those of the "
    "scenario") {
  const ScenarioRun& both = exact_run();
  const std::string allowed = GENERATE("sensor_left", "sensor_right");
  const std::string other = allowed == "sensor_left" ? "sensor_right" : "sensor_left";
  const ScenarioRun one(
      Variant("<stride:EarlyReturn components=\"" + other + "\" allowed=\"false\"/>").file(),
      kSensorsStop);
  for (const std::string& sensor : kSensors) {
    CHECK(both.payloads(sensor, "transmit.frame", "sent") ==
          one.payloads(sensor, "transmit.frame", "sent"));
  }
  for (const char* outcome : {"to_reader.frame", "left.to.frame", "right.to.frame"}) {
    CHECK(both.payloads("channel", outcome, "sent") == one.payloads("channel", outcome, "sent"));
  }
  CHECK(both.payloads("reader", "report.text", "sent") ==
        one.payloads("reader", "report.text", "sent"));
  CHECK(both.instants(allowed, "transmit.frame", "sent") ==
        one.instants(allowed, "transmit.frame", "sent"));
  CHECK(both.instants(other, "transmit.frame", "sent") !=
        one.instants(other, "transmit.frame", "sent"));
}

TEST_CASE("which of the sensors is taken back changes no byte, and no trace has a step twice") {
  const Variant right(""), left("<stride:Host components=\"sensor_right\" process=\"false\"/>");
  const ScenarioRun right_goes_back = right.traced_run(), left_goes_back = left.traced_run();
  CHECK(unit_entry(left_goes_back, "sensor_left").at("host").at("snapshots").at("restored") > 0);
  for (const char* file : {"signals.csv", "events.csv"}) {
    const bool is_same = text_of(right_goes_back.file(file)) == text_of(left_goes_back.file(file));
    INFO(file);
    CHECK(is_same);
  }
  for (const std::string& sensor : kSensors) {
    const bool is_same = signals_of(right.trace(sensor)) == signals_of(left.trace(sensor));
    INFO(sensor);
    CHECK(is_same);
    CHECK(fs::file_size(right.trace(sensor)) > 10000);
  }
}

TEST_CASE("two sensors that may have no process are refused, with what to write") {
  const Variant refused("<stride:Host components=\"sensor_*\" process=\"false\"/>");
  const Outcome outcome = run_program({"check", refused.file()});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(
      outcome.err,
      Catch::Contains("'sensor_left' and 'sensor_right' may both return early") &&
          Catch::Contains("<stride:Host components=\"sensor_right\" snapshots=\"true\"/>") &&
          Catch::Contains("<stride:EarlyReturn components=\"sensor_right\" allowed=\"false\"/>"));
}
