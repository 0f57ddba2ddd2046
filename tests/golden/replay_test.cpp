// What the sensors of every scenario received, played to them alone: the same outputs bit by bit,
// and the same messages at the same instants.
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"
#include "units/player/stimuli.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLeastRows = 11;

/// All in scenarios/ that have golden results, so that nothing is to be fetched for them, and a
/// sensor; with the names of these.
std::map<std::string, std::vector<std::string>> scenarios_with_sensors() {
  static const std::regex kSensor(R"re(<ssd:Component name="(\w+)"[^>]* source="sensor.fmu")re");
  std::map<std::string, std::vector<std::string>> found;
  for (const auto& entry : fs::directory_iterator(fs::path(STRIDE_SOURCE_DIR) / "scenarios")) {
    if (!fs::exists(entry.path() / "golden")) continue;
    const std::string name = entry.path().filename().string();
    const std::string text = text_of(entry.path() / (name + ".ssd"));
    for (std::sregex_iterator it(text.begin(), text.end(), kSensor), end; it != end; ++it) {
      found[name].push_back((*it)[1]);
    }
  }
  return found;
}

/// What the scenario sets of the component's early returns.
std::string early_return(const std::string& scenario, const std::string& component) {
  const std::string text = text_of(scenario_folder(scenario) / (scenario + ".ssd"));
  std::smatch match;
  const std::regex wanted("<stride:EarlyReturn components=\"" + component + "\"[^>]*>");
  return std::regex_search(text, match, wanted) ? match[0].str() : "";
}

/// The component and its player, in one step from start to stop, so that communication points are
/// those of the original.
std::string replay_scenario(const player::Stimuli& stimuli, const std::string& annotation) {
  const std::string& component = stimuli.component;
  const std::string stop = std::to_string(stride::to_seconds(stimuli.end()));
  std::string connections;
  for (const player::Input& input : stimuli.inputs) {
    connections += "<ssd:Connection startElement=\"player\" startConnector=\"" + input.name +
                   "\" endElement=\"" + component + "\" endConnector=\"" + input.name + "\"/>\n";
  }
  return "<ssd:SystemStructureDescription version=\"2.0\" name=\"replay\"\n"
         "    xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\"\n"
         "    xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\">\n"
         "<ssd:System name=\"replay\"><ssd:Elements>\n"
         "<ssd:Component name=\"player\" source=\"player.fmu\"/>\n"
         "<ssd:Component name=\"" +
         component +
         "\" source=\"sensor.fmu\"/>\n"
         "</ssd:Elements><ssd:Connections>\n" +
         connections +
         "</ssd:Connections></ssd:System>\n"
         "<ssd:DefaultExperiment stopTime=\"" +
         stop +
         "\"/>\n"
         "<ssd:Annotations><ssc:Annotation type=\"org.stride\">\n"
         "<stride:Scenario xmlns:stride=\"urn:org.stride:scenario:1\">\n"
         "<stride:Step size=\"" +
         stop + "\" maximum=\"" + stop + "\"/>\n" + annotation +
         "</stride:Scenario></ssc:Annotation></ssd:Annotations>\n"
         "</ssd:SystemStructureDescription>\n";
}

/// The start values that the head of a stimuli file lists, as the command line takes them.
Arguments start_values(const std::string& stimuli, const std::string& component) {
  Arguments arguments;
  std::istringstream lines(stimuli.substr(0, stimuli.find("\ntime,")));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("set,", 0) != 0) continue;
    const std::size_t comma = line.find(',', 4);
    arguments.insert(arguments.end(), {"--set", component + "." + line.substr(4, comma - 4) + "=" +
                                                    line.substr(comma + 1)});
  }
  return arguments;
}

std::string rows(const std::string& stimuli) { return stimuli.substr(stimuli.find("\ntime,")); }

/// At which instants the unit was in Event Mode.
std::set<std::string> event_times(const std::string& stimuli) {
  std::set<std::string> times;
  std::istringstream lines(rows(stimuli));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comma = line.find(',');
    const bool has_event = comma + 1 < line.size() && std::isdigit(line[comma + 1]) != 0;
    if (has_event) times.insert(line.substr(0, comma));
  }
  return times;
}

/// Whether the title is that of another signal of the component than what it received.
bool is_own(const std::string& title, const player::Stimuli& stimuli) {
  const std::string name = title.substr(0, title.find(" ["));
  for (const player::Input& input : stimuli.inputs) {
    if (name == stimuli.component + "." + input.name) return false;
  }
  return name.rfind(stimuli.component + ".", 0) == 0;
}

/// By instant, which may have several rows.
std::map<std::string, std::string> own_signals(const Csv& signals, const player::Stimuli& stimuli) {
  std::map<std::string, std::string> values;
  std::vector<std::size_t> columns;
  for (std::size_t k = 1; k < signals.titles().size(); ++k) {
    if (is_own(signals.titles()[k], stimuli)) columns.push_back(k);
  }
  for (std::size_t i = 0; i < signals.size(); ++i) {
    std::string& row = values[signals.row(i)[0]];
    for (const std::size_t k : columns) row += "," + signals.row(i)[k];
    row += "\n";
  }
  return values;
}

std::vector<std::string> sent_by(const Csv& events, const std::string& component) {
  std::vector<std::string> sent;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto& row = events.row(i);
    if (row[2] == component && row[4] == "sent") {
      sent.push_back(row[0] + "," + row[1] + "," + row[3] + "," + row[5]);
    }
  }
  return sent;
}

void check_replay(const ScenarioRun& original, const std::string& scenario,
                  const std::string& component, const fs::path& captured, bool skips) {
  const ScratchFolder folder;
  const std::string text = text_of(captured);
  const player::Stimuli stimuli = player::parse_stimuli(text, captured.string());
  REQUIRE(
      run_program({"pack", captured.string(), "-o", (folder / "player.fmu").string()}).exit_code ==
      0);
  std::ofstream(folder / "replay.ssd")
      << replay_scenario(stimuli, early_return(scenario, component));
  Arguments arguments = start_values(text, component);
  arguments.insert(arguments.end(), {"--no-trace", "--signals", component + ".*", "--capture",
                                     component + "=" + (folder / "again.csv").string()});
  if (!skips) arguments.push_back("--no-idle-skip");
  const ScenarioRun replay((folder / "replay.ssd").string(), arguments);

  const bool same_stimuli = rows(text_of(folder / "again.csv")) == rows(text);
  CHECK(same_stimuli);
  CHECK(sent_by(replay.events(), component) == sent_by(original.events(), component));
  const auto expected = own_signals(original.signals(), stimuli);
  const auto found = own_signals(replay.signals(), stimuli);
  CHECK(found.size() >= kLeastRows);
  // where a unit was left alone, its outputs are on their tangents until it is called again
  const std::set<std::string> exact = event_times(text);
  std::size_t differences = 0;
  for (const auto& [time, row] : found) {
    if (!skips || exact.count(time) != 0) differences += row != expected.at(time);
  }
  CHECK(differences == 0);
  if (!skips) CHECK(found.size() == expected.size());
}

/// What was in force where each step began, and each message.
struct Course {
  std::map<stride::Time, std::vector<double>> values;
  std::vector<std::pair<stride::Time, stride::Binary>> frames;
};

Course course_of(const player::Stimuli& stimuli) {
  Course course;
  std::vector<double> now(stimuli.inputs.size());
  for (const player::Entry& entry : stimuli.entries) {
    if (entry.kind == player::Entry::Kind::Step) course.values[entry.time] = now;
    if (entry.kind != player::Entry::Kind::Value) continue;
    const player::Values& values = stimuli.inputs[entry.input].values;
    if (const auto* numbers = std::get_if<std::vector<double>>(&values)) {
      now[entry.input] = (*numbers)[entry.first];
    } else {
      course.frames.emplace_back(entry.time,
                                 std::get<std::vector<stride::Binary>>(values)[entry.first]);
    }
  }
  return course;
}

}  // namespace

TEST_CASE("every scenario with a sensor is known, so that none is left out") {
  const auto scenarios = scenarios_with_sensors();
  CHECK(scenarios.size() >= 7);
  CHECK(scenarios.at("nfc_two_tags") == std::vector<std::string>{"sensor_left", "sensor_right"});
}

TEST_CASE("each sensor of each scenario gives the same results when it is replayed alone") {
  const bool skips = GENERATE(false, true);
  for (const auto& [scenario, sensors] : scenarios_with_sensors()) {
    if (scenario == "replay_sensor") continue;  // where no unit is idle, by its annotation
    const ScratchFolder folder;
    Arguments arguments = without_judge(scenario);
    arguments.push_back("--no-trace");
    if (!skips) arguments.push_back("--no-idle-skip");
    for (const std::string& sensor : sensors) {
      arguments.insert(arguments.end(), {"--signals", sensor + ".*", "--capture",
                                         sensor + "=" + (folder / sensor).string()});
    }
    const ScenarioRun original(scenario, arguments);
    for (const std::string& sensor : sensors) {
      INFO(scenario << ", " << sensor << (skips ? ", with" : ", without") << " idle skipping");
      check_replay(original, scenario, sensor, folder / sensor, skips);
    }
  }
}

TEST_CASE("replay_sensor: the device does what it did in nfc_approach") {
  const ScenarioRun run("replay_sensor", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("replay_sensor", run) == "");
  const Csv original(scenario_folder("nfc_approach") / "golden" / "events.csv");
  CHECK(sent_by(run.events(), "sensor").size() == 3);
  CHECK(sent_by(run.events(), "sensor") == sent_by(original, "sensor"));
}

TEST_CASE("replay_sensor: its stimuli are those that nfc_approach gives") {
  const fs::path kept = scenario_folder("replay_sensor") / "player" / "stimuli.csv";
  const ScratchFolder folder;
  const ScenarioRun original("nfc_approach",
                             {"--step", "0.02", "--no-idle-skip", "--no-trace", "--capture",
                              "sensor=" + (folder / "new.csv").string()});
  INFO("capture them again: the command is in scenarios/replay_sensor/README.md");
  const Course found = course_of(player::load_stimuli((folder / "new.csv").string()));
  const Course expected = course_of(player::load_stimuli(kept.string()));
  CHECK(found.frames == expected.frames);
  REQUIRE(found.values.size() == expected.values.size());
  constexpr double kTolerance = 1e-6;  // for what differs between machines
  for (const auto& [time, values] : expected.values) {
    REQUIRE(found.values.count(time) == 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double other = found.values.at(time)[i];
      CHECK(std::abs(other - values[i]) <= kTolerance * std::abs(values[i]) + 1e-12);
    }
  }
}
