// The flagship scenario: the same results as ever, and what it is there to show.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/cli/program.h"
#include "tests/cli/results.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

fs::path golden(const std::string& file) {
  return fs::path(STRIDE_SOURCE_DIR) / "scenarios/nfc_approach/golden" / file;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// One run of the scenario, in a folder that goes with the object.
class Run {
 public:
  explicit Run(const std::string& step = "0.001", const std::string& threads = "1") {
    std::string name = (fs::temp_directory_path() / "stride-golden-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    const std::string scenario = STRIDE_SOURCE_DIR "/scenarios/nfc_approach/nfc_approach.ssd";
    const Outcome outcome = run_program({"run", scenario, "--step", step, "--threads", threads,
                                         "--out", folder_.string(), "--quiet"});
    if (outcome.exit_code != 0) throw std::runtime_error("the run failed: " + outcome.err);
  }
  ~Run() { fs::remove_all(folder_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_;
};

/// The tests below look at the same run.
const Run& run() {
  static const Run only;
  return only;
}
const Csv& signals() {
  static const Csv only(run().file("signals.csv"));
  return only;
}
const Csv& events() {
  static const Csv only(run().file("events.csv"));
  return only;
}

double at(const std::string& time, const std::string& signal) {
  return signals().number(signals().row_at(time), signals().column(signal));
}

struct Extremes {
  double least, most;
};

/// Over the communication points of an interval, its ends included.
Extremes between(const std::string& from, const std::string& to, const std::string& signal) {
  const std::size_t column = signals().column(signal);
  Extremes extremes{HUGE_VAL, -HUGE_VAL};
  for (std::size_t row = signals().row_at(from); row <= signals().row_at(to); ++row) {
    const double value = signals().number(row, column);
    extremes = {std::min(extremes.least, value), std::max(extremes.most, value)};
  }
  return extremes;
}

/// When a component sent or received on a variable, as the file writes the instants.
std::vector<std::string> instants(const std::string& component, const std::string& variable,
                                  const std::string& direction) {
  std::vector<std::string> times;
  for (std::size_t i = 0; i < events().size(); ++i) {
    const auto& row = events().row(i);
    if (row[2] == component && row[3] == variable && row[4] == direction) times.push_back(row[0]);
  }
  return times;
}

using Instants = std::vector<std::string>;

struct Tolerance {
  double absolute, relative;
  bool allows(double value, double expected) const {
    return std::abs(value - expected) <= absolute + relative * std::abs(expected);
  }
};

std::map<std::string, Tolerance> read_tolerances() {
  const Csv file(golden("tolerances.csv"));
  std::map<std::string, Tolerance> tolerances;
  for (std::size_t i = 0; i < file.size(); ++i) {
    tolerances[file.row(i)[0]] = {file.number(i, 1), file.number(i, 2)};
  }
  return tolerances;
}

}  // namespace

TEST_CASE("the messages are the golden ones") {
  CHECK(text_of(run().file("events.csv")) == text_of(golden("events.csv")));
}

TEST_CASE("the signals are the golden ones, within the tolerances beside them") {
  const Csv expected(golden("signals.csv"));
  REQUIRE(signals().titles() == expected.titles());
  REQUIRE(expected.size() == 301);
  auto tolerances = read_tolerances();
  for (const auto& [signal, tolerance] : tolerances) {
    INFO("tolerances.csv: " << signal);
    CHECK(expected.has(signal));
  }
  std::size_t row = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string& time = expected.row(i).front();
    while (row < signals().size() && signals().row(row).front() != time) ++row;
    INFO(time << " s");
    REQUIRE(row < signals().size());
    for (std::size_t k = 1; k < expected.titles().size(); ++k) {
      const Tolerance tolerance = tolerances[expected.titles()[k]];  // zeros where there is none
      if (tolerance.allows(signals().number(row, k), expected.number(i, k))) continue;
      FAIL_CHECK(expected.titles()[k] << " is " << signals().row(row)[k] << ", expected "
                                      << expected.row(i)[k]);
    }
  }
}

TEST_CASE("a second run writes the same bytes, on two threads too") {
  const Run second("0.001", GENERATE("1", "2"));
  for (const char* file : {"signals.csv", "events.csv", "signals.vcd"}) {
    INFO(file);
    const std::string first = text_of(run().file(file));
    CHECK(first.size() > 1000);
    CHECK(first == text_of(second.file(file)));
  }
}

TEST_CASE("the messages do not depend on the communication step size") {
  const std::string step = GENERATE("0.005", "0.0007");
  CHECK(text_of(Run(step).file("events.csv")) == text_of(run().file("events.csv")));
}

TEST_CASE("six messages are sent, five are heard, one of them wrongly, three are answered") {
  CHECK(instants("reader", "transmit.frame", "sent") ==
        Instants{"6.5", "8", "14.2", "15.05", "24", "24.1"});
  const double heard[] = {8, 14.2, 15.05, 24, 24.1};
  const Instants requests = instants("sensor", "receive.frame", "received");
  REQUIRE(requests.size() == 5);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    CHECK(std::stod(requests[i]) > heard[i] + 0.0002);  // when it has ended, not when it begins
    CHECK(std::stod(requests[i]) < heard[i] + 0.0004);
  }
  const Instants answers = instants("sensor", "transmit.frame", "sent");
  const Instants answered = instants("reader", "receive.frame", "received");
  REQUIRE(answers.size() == 3);
  REQUIRE(answered.size() == 3);
  const double asked[] = {14.2, 24, 24.1};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    CHECK(std::stod(answers[i]) > asked[i] + 0.0003);
    CHECK(std::stod(answers[i]) < asked[i] + 0.0011);  // within the step
    CHECK(std::stod(answered[i]) > std::stod(answers[i]) + 0.0002);
    CHECK(std::stod(answered[i]) < std::stod(answers[i]) + 0.0007);
  }
  CHECK(at("30", "reader.messages.sent") == 6);
  CHECK(at("30", "reader.messages.answered") == 3);
  CHECK(at("30", "reader.messages.unanswered") == 3);
  CHECK(at("30", "sensor.frames.received") == 3);
  CHECK(at("30", "sensor.frames.rejected") == 1);
  CHECK(at("30", "sensor.frames.sent") == 3);
}

TEST_CASE("the arm approaches, waits near the sensor, and withdraws") {
  CHECK(at("0", "channel.distance [m]") == Approx(0.4).margin(0.001));
  CHECK(at("6", "channel.distance [m]") == Approx(0.2).margin(0.001));
  CHECK(at("17", "channel.distance [m]") == Approx(0.05).margin(0.001));
  const Extremes near = between("21", "25", "channel.distance [m]");
  CHECK(near.least > 0.0245);
  CHECK(near.most < 0.0255);
  CHECK(at("30", "channel.distance [m]") == Approx(0.2).margin(0.001));
}

TEST_CASE("the first two messages find the sensor too far away, though it is powered") {
  CHECK(between("6.2", "8.9", "reader.carrier_power [W]").least > 0);
  CHECK(between("6.2", "8.9", "channel.distance [m]").least > 0.12);
  CHECK(between("6.2", "8.9", "channel.tag_power [W]").most < 1e-5);
  CHECK(between("6.2", "8.9", "sensor.mcu.powered").least == 1);
  CHECK(at("7.9", "sensor.frames.rejected") == 0);
  CHECK(at("8.1", "sensor.frames.rejected") == 1);
  CHECK(at("9", "sensor.frames.received") == 0);
  CHECK(at("9", "reader.messages.unanswered") == 2);
}

TEST_CASE("the LED empties the capacitor, so the fourth message is not answered") {
  CHECK(at("14.2", "sensor.led") == 0);
  CHECK(at("14.201", "sensor.led") == 1);
  CHECK(at("14.201", "sensor.energy.load [W]") > 10 * at("14.201", "sensor.energy.intake [W]"));
  CHECK(at("14.2", "sensor.capacitor.voltage [V]") > 3);
  CHECK(at("14.2", "sensor.mcu.powered") == 1);
  CHECK(between("14.2", "15.05", "sensor.capacitor.voltage [V]").least < 2);
  CHECK(at("15.05", "sensor.mcu.powered") == 0);
  CHECK(at("15.05", "sensor.led") == 0);
  CHECK(between("14.5", "20.8", "sensor.mcu.powered").most == 0);
}

TEST_CASE("near the reader the capacitor charges, and two messages are answered") {
  CHECK(at("20.8", "sensor.mcu.powered") == 0);
  CHECK(at("21", "sensor.mcu.powered") == 1);
  CHECK(at("21.1", "sensor.capacitor.voltage [V]") >
        at("21", "sensor.capacitor.voltage [V]") + 0.5);
  CHECK(between("22", "25", "sensor.capacitor.voltage [V]").least > 4.9);
  CHECK(at("24.002", "reader.messages.answered") == 2);
  CHECK(at("24.102", "reader.messages.answered") == 3);
}

TEST_CASE("the reader learns the temperature that the environment has") {
  CHECK(at("24", "reader.measured.temperature [degC]") == 0);
  CHECK(at("30", "reader.measured.temperature [degC]") ==
        Approx(at("24", "environment.temperature [degC]")).margin(0.05));
}

TEST_CASE("at the end the antenna is on, and the field gets too weak to live on") {
  CHECK(between("25", "30", "reader.carrier_power [W]").least > 0);
  CHECK(at("25", "sensor.energy.intake [W]") > at("25", "sensor.energy.load [W]"));
  CHECK(at("30", "sensor.energy.intake [W]") < at("30", "sensor.energy.load [W]"));
  CHECK(at("30", "sensor.capacitor.voltage [V]") < at("25", "sensor.capacitor.voltage [V]"));
  CHECK(at("30", "sensor.mcu.powered") == 1);
}
