// The flagship scenario: the same results as ever, and what it is there to show.
#include <utility>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

ScenarioRun run_with(const std::string& step, const std::string& threads = "1") {
  return ScenarioRun("nfc_approach", {"--no-idle-skip", "--step", step, "--threads", threads});
}

/// The tests below look at the same run.
const ScenarioRun& run() {
  static const ScenarioRun only = run_with("0.001");
  return only;
}

double at(const std::string& time, const std::string& signal) { return run().at(time, signal); }

Extremes between(const std::string& from, const std::string& to, const std::string& signal) {
  return run().between(from, to, signal);
}

using Instants = std::vector<std::string>;

Instants instants(const std::string& component, const std::string& variable,
                  const std::string& direction) {
  return run().instants(component, variable, direction);
}

}  // namespace

TEST_CASE("the results are the golden ones") {
  CHECK(golden_differences("nfc_approach", run()) == "");
}

TEST_CASE("a second run writes the same bytes, on two threads too") {
  const ScenarioRun second = run_with("0.001", GENERATE("1", "2"));
  for (const char* file : {"signals.csv", "events.csv", "signals.vcd", "activity.csv"}) {
    INFO(file);
    const std::string first = text_of(run().file(file));
    CHECK(first.size() > 1000);
    CHECK(first == text_of(second.file(file)));
  }
}

TEST_CASE("the messages do not depend on the communication step size") {
  const std::string step = GENERATE("0.005", "0.0007");
  CHECK(text_of(run_with(step).file("events.csv")) == text_of(run().file("events.csv")));
}

TEST_CASE("six messages are sent, five are received, one of them wrongly, three are answered") {
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
  CHECK(at("6", "channel.distance [m]") == Approx(0.124).margin(0.001));
  CHECK(at("17", "channel.distance [m]") == Approx(0.05).margin(0.001));
  const Extremes near = between("21", "25", "channel.distance [m]");
  CHECK(near.least > 0.0245);
  CHECK(near.most < 0.0255);
  CHECK(at("30", "channel.distance [m]") == Approx(0.2).margin(0.001));
}

TEST_CASE("the first two messages find the sensor too far away, though it is powered") {
  CHECK(between("6.2", "8.9", "reader.carrier_power [W]").least > 0);
  CHECK(between("6.2", "8.9", "channel.distance [m]").least > 0.08);
  CHECK(at("6.5", "channel.tag_voltage [V]") < 3.6);  // for the demodulator
  CHECK(at("8", "channel.tag_voltage [V]") > 3.6);
  CHECK(between("6.2", "8.9", "sensor.mcu.powered").least == 1);
  CHECK(at("7.9", "sensor.frames.rejected") == 0);
  CHECK(at("8.1", "sensor.frames.rejected") == 1);
  CHECK(at("9", "sensor.frames.received") == 0);
  CHECK(at("9", "reader.messages.unanswered") == 2);
}

TEST_CASE("the LED empties the capacitor, so the fourth message is not answered") {
  CHECK(at("14.2", "sensor.led") == 0);
  CHECK(at("14.201", "sensor.led") == 1);
  CHECK(at("14.201", "sensor.energy.load [W]") > 3 * at("14.201", "sensor.energy.intake [W]"));
  CHECK(at("14.2", "sensor.capacitor.voltage [V]") > 3);
  CHECK(at("14.2", "sensor.mcu.powered") == 1);
  CHECK(between("14.2", "15.05", "sensor.capacitor.voltage [V]").least < 2);
  CHECK(at("15.05", "sensor.mcu.powered") == 0);
  CHECK(at("15.05", "sensor.led") == 0);
  CHECK(between("14.9", "20.8", "sensor.mcu.powered").most == 0);
}

TEST_CASE(
    "in the field the supply jumps to its maximum, if the field gives more than the sensor takes") {
  const std::string supply = "sensor.supply.voltage [V]";
  CHECK(at("13.899", supply) < 3.3);
  CHECK(at("13.9", supply) == 5);
  CHECK(at("15.499", supply) == 5);
  CHECK(at("15.5", supply) < 2.6);
  CHECK(at("20.9", supply) == 5);
  CHECK(between("21.2", "27", supply).least > 4.9);
  // too little voltage feeds the sensor, and charges nothing
  CHECK(between("6.1", "9", supply).most < 5);
  CHECK(between("6.1", "9", "sensor.energy.intake [W]").most ==
        Approx(between("6.1", "9", "sensor.energy.load [W]").most));
}

TEST_CASE("the charge rises in such a field, and falls slowly elsewhere") {
  const std::string charge = "sensor.capacitor.charge [C]";
  CHECK(at("14.1", charge) > 1.02 * at("13.9", charge));
  CHECK(at("15.4", charge) > 1.15 * at("14.9", charge));
  CHECK(at("21.3", charge) > 1.7 * at("20.9", charge));
  for (const auto& [from, to] :
       {std::pair("0.1", "6"), std::pair("6.1", "9"), std::pair("9", "13.8"),
        std::pair("15.6", "20.8"), std::pair("28", "30")}) {
    INFO(from << " to " << to << " s");
    CHECK(at(to, charge) < at(from, charge));
    CHECK(at(to, charge) > 0.95 * at(from, charge));
  }
}

TEST_CASE("at 21 s there is more energy than ever before") {
  const std::string intake = "sensor.energy.intake [W]";
  CHECK(between("21", "21.1", intake).least > 5 * between("0", "20.8", intake).most);
}

TEST_CASE("the intake fluctuates while the arm approaches, for the arm trembles") {
  const Csv& signals = run().signals();
  const std::vector<double> times = signals.numbers("time");
  const std::vector<double> intake = signals.numbers("sensor.energy.intake [W]");
  int turns = 0;
  for (std::size_t i = 20; i < times.size(); i += 10) {
    if (times[i] < 8 || times[i] > 9) continue;
    const double before = intake[i - 10] - intake[i - 20];
    const double after = intake[i] - intake[i - 10];
    turns += static_cast<int>(before * after < 0);
  }
  CHECK(turns > 8);
}

TEST_CASE("near the reader the capacitor charges, and two messages are answered") {
  CHECK(at("20.8", "sensor.mcu.powered") == 0);
  CHECK(at("21", "sensor.mcu.powered") == 1);
  CHECK(at("21.2", "sensor.capacitor.voltage [V]") >
        at("21", "sensor.capacitor.voltage [V]") + 0.5);
  CHECK(between("22", "25", "sensor.capacitor.voltage [V]").least > 4.9);
  CHECK(at("24.002", "reader.messages.answered") == 2);
  CHECK(at("24.102", "reader.messages.answered") == 3);
}

TEST_CASE("the reader learns the temperature that the environment has") {
  CHECK(at("24", "reader.measured.temperature [degC]") == 0);
  CHECK(at("30", "reader.measured.temperature [degC]") ==
        Approx(at("24", "environment.temperature [degC]")).margin(0.05));
  CHECK(at("24", "ground_truth.passed") == 0);
  CHECK(at("24.002", "ground_truth.passed") == 1);
  CHECK(at("30", "ground_truth.measurements.right") == 1);
  CHECK(at("30", "ground_truth.measurements.wrong") == 0);
}

TEST_CASE("at the end the antenna is on, and the field is too weak to supply the sensor") {
  CHECK(between("25", "30", "reader.carrier_power [W]").least > 0);
  CHECK(at("25", "sensor.energy.intake [W]") > at("25", "sensor.energy.load [W]"));
  CHECK(at("30", "sensor.energy.intake [W]") < at("30", "sensor.energy.load [W]"));
  CHECK(at("30", "sensor.capacitor.voltage [V]") < at("25", "sensor.capacitor.voltage [V]"));
  CHECK(at("30", "sensor.mcu.powered") == 1);
}
