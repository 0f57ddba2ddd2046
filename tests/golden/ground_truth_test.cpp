// A sensor on a table, without a world: what it measures and logs is compared with what is true,
// and the run passes or fails by that.
#include <nlohmann/json.hpp>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A new measurement, then four that the sensor takes by itself and keeps.
constexpr const char* kProgram = R"(<reader-program version="1">
    <antenna on="0.1" off="60" power="0.5"/>
    <command at="1.5" name="read_temperature"/>
    <command at="1.6" name="set_sampling_period" period="1"/>
    <command at="6.4" name="read_log"><expect samples="4"/></command>
  </reader-program>)";

std::string value(const std::string& name, double number) {
  return "<ssv:Parameter name=\"" + name + "\"><ssv:Float64 value=\"" + std::to_string(number) +
         "\"/></ssv:Parameter>";
}

/// The reader is 2.5 cm above the sensor, whose case cools from 30 degC by 0.08 K/s.
std::string table(const std::string& ages) {
  const std::string parameters =
      "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
      "<ssv:ParameterSet version=\"2.0\" name=\"table\""
      " xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">"
      "<ssv:Parameters>" +
      value("channel.reader_coil.position.z", 0.025) +
      value("environment.case.initial_temperature", 30) + value("ground_truth.tolerance", 0.03) +
      value("ground_truth.max_age", 0.01) +
      "</ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding>"
      "</ssd:ParameterBindings>";
  std::string text = scenario_text(
      {component("environment", "environment.fmu") + component("channel", "nfc_channel.fmu") +
           component("reader", "reader.fmu") + component("sensor", "sensor.fmu") +
           component("ground_truth", "ground_truth.fmu"),
       connection("reader.carrier_power", "channel.carrier_power") +
           connection("channel.tag_power", "sensor.field_power") +
           connection("environment.temperature", "sensor.adc.temperature") +
           connection("reader.transmit.clock", "channel.from_reader.clock") +
           connection("reader.transmit.frame", "channel.from_reader.frame") +
           connection("channel.to_tag.clock", "sensor.receive.clock") +
           connection("channel.to_tag.frame", "sensor.receive.frame") +
           connection("sensor.transmit.clock", "channel.from_tag.clock") +
           connection("sensor.transmit.frame", "channel.from_tag.frame") +
           connection("channel.to_reader.clock", "reader.receive.clock") +
           connection("channel.to_reader.frame", "reader.receive.frame") +
           connection("environment.temperature", "ground_truth.truth") +
           connection("reader.measurement.clock", "ground_truth.measurement.clock") +
           connection("reader.measurement.temperature", "ground_truth.measurement.value") + ages,
       "<stride:Step size=\"0.005\"/>\n", "<ssd:DefaultExperiment stopTime=\"7\"/>\n"});
  const std::string elements = "<ssd:Elements>";
  return text.insert(text.find(elements), parameters);
}

std::string ages() {
  return connection("reader.measurement.age", "ground_truth.measurement.age") +
         connection("reader.measurement.age_resolution", "ground_truth.measurement.age_resolution");
}

/// A scenario with a reader of its own beside it, which is found before that of the build.
struct Table : Workspace {
  explicit Table(const std::string& age_connections = ages()) : Workspace(table(age_connections)) {
    fs::create_directory(*this / "program");
    scratch().write("program/program.xml", kProgram);
    pack(unit_library("reader"), "program", "reader.fmu");
  }
  void pack(const std::string& library, const std::string& resources, const std::string& fmu) {
    REQUIRE(stride({"pack", library, "--resources", resources, "-o", fmu}).exit_code == 0);
  }
  /// What is recorded is what the judge has found.
  Outcome run(Arguments options) const {
    options.insert(options.end(), {"--no-trace", "--signals", "ground_truth.*"});
    return Workspace::run(options);
  }
  nlohmann::json verdict() const {
    return nlohmann::json::parse(result("run.json"))["verdicts"].at(0);
  }
};

}  // namespace

TEST_CASE("a good sensor passes, with what it logged, too") {
  const Table table;
  const Outcome outcome = table.run(GENERATE(Arguments{}, Arguments{"--no-idle-skip"}));
  CAPTURE(outcome.out, outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, !Contains("warning"));
  CHECK(table.verdict()["component"] == "ground_truth");
  CHECK(table.verdict()["passed"] == true);
  CHECK_THAT(table.verdict()["text"].get<std::string>(), Contains("5 of 5 measurements right"));
  const Csv signals = table.signals();
  CHECK(signals.number(signals.size() - 1, signals.column("ground_truth.measurements.right")) == 5);
}

TEST_CASE("an ADC without calibration fails, and the worst case is named") {
  const Table table;
  const Outcome outcome = table.run({"--set", "sensor.adc.offset_error=0.5"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("unit 'ground_truth'") && Contains("measurement at 1.50") &&
                 Contains(" degC is wrong, error 0.") && Contains("tolerance 0.03 K") &&
                 Contains("stride: error: the run is complete, and has failed by 1 of 1 verdict\n  "
                          "ground_truth: 0 of 5 measurements right; worst error 0."));
  CHECK_THAT(outcome.out, Contains("Results in out:"));
  CHECK(table.verdict()["passed"] == false);
  const Csv signals = table.signals();
  const auto last = [&](const std::string& name) {
    return signals.number(signals.size() - 1, signals.column("ground_truth." + name));
  };
  CHECK(last("measurements.wrong") == 5);
  CHECK(last("worst.error [K]") == Approx(0.5).margin(0.1));
  CHECK(last("worst.measured [degC]") ==
        Approx(last("worst.truth [degC]") + last("worst.error [K]")));
}

TEST_CASE("too few measurements fail") {
  const Table table;
  const Outcome more = table.run({"--quiet", "--set", "ground_truth.minimum_measurements=6"});
  CHECK(more.exit_code == 1);
  CHECK_THAT(more.err, Contains("5 of 5 measurements right; expected at least 6; worst error"));
  const Outcome none = table.run({"--quiet", "--stop", "1"});
  CHECK(none.exit_code == 1);
  CHECK_THAT(none.err, Contains("0 of 0 measurements right; expected at least 1"));
  CHECK(table.run({"--quiet", "--stop", "1", "--set", "ground_truth.minimum_measurements=0"})
            .exit_code == 0);
}

TEST_CASE("a log that is taken for new is wrong, for the case has cooled meanwhile") {
  const Table table("");
  const Outcome outcome = table.run({"--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(table.verdict()["text"].get<std::string>(), Contains("1 of 5 measurements right"));
}

TEST_CASE("a measurement of a truth that is no longer recorded is reported, and is not a mistake") {
  const Table table;
  const Outcome outcome =
      table.run({"--quiet", "--set", "ground_truth.memory=0.5", "--set",
                 "sensor.adc.offset_error=5", "--set", "ground_truth.minimum_measurements=0"});
  CHECK_THAT(outcome.err, Contains("of which the truth is not remembered; it is not compared"));
  CHECK_THAT(table.verdict()["text"].get<std::string>(), Contains("4 too old to be checked"));
}

TEST_CASE("the judge of another quantity is another file, and units are converted") {
  Table table;
  fs::create_directory(table / "kelvin");
  table.scratch().write("kelvin/quantity.xml",
                        "<quantity version=\"1\" unit=\"K\" difference=\"K\"/>");
  table.pack(unit_library("ground_truth"), "kelvin", "ground_truth.fmu");
  const Outcome outcome = table.run({"--quiet"});
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(table.verdict()["text"].get<std::string>(),
             Contains("5 of 5 measurements right; worst error ") && Contains(" K for 30"));
}
