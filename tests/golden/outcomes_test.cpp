// What the smaller scenarios are there to show, and their golden results.
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

/// nfc_two_tags with another text in the place of its EarlyReturn.
class OtherEarlyReturn {
 public:
  explicit OtherEarlyReturn(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "stride-two-tags-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    const std::string before =
        "<stride:EarlyReturn components=\"sensor_right\" allowed=\"false\"/>";
    std::string scenario = text_of(scenario_folder("nfc_two_tags") / "nfc_two_tags.ssd");
    scenario.replace(scenario.find(before), before.size(), text);
    std::ofstream(folder_ / "other.ssd") << scenario;
    fs::copy_file(scenario_folder("nfc_two_tags") / "sensors.ssv", folder_ / "sensors.ssv");
  }
  ~OtherEarlyReturn() { fs::remove_all(folder_); }
  OtherEarlyReturn(const OtherEarlyReturn&) = delete;
  OtherEarlyReturn& operator=(const OtherEarlyReturn&) = delete;

  std::string file() const { return (folder_ / "other.ssd").string(); }

 private:
  fs::path folder_;
};

const ScenarioRun& two_tags() {
  static const ScenarioRun only("nfc_two_tags", {"--no-trace", "--no-idle-skip"});
  return only;
}

}  // namespace

TEST_CASE("of a run that is not as its golden results it is said where it differs first") {
  const ScenarioRun run(
      "nfc_far", {"--no-trace", "--no-idle-skip", "--set", "sensor.power.capacitance=0.0004"});
  const std::string differences = golden_differences("nfc_far", run);
  CHECK_THAT(differences, Catch::Matchers::StartsWith(
                              "\ndiffer first at t = 0 s in signal sensor.capacitor.charge\n"));
  CHECK_THAT(differences, Catch::Matchers::Contains("  signal  sensor.capacitor.voltage  "));
}

TEST_CASE("nfc_far: no message arrives, as the program expects") {
  const ScenarioRun run("nfc_far", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("nfc_far", run) == "");
  CHECK(run.at("10", "reader.messages.sent") == 3);
  CHECK(run.at("10", "reader.messages.retries") == 8);
  CHECK(run.at("10", "reader.messages.answered") == 0);
  CHECK(run.at("10", "reader.messages.unexpected") == 0);
}

TEST_CASE("nfc_brownout: the sensor goes off with its LED on, and comes back") {
  const ScenarioRun run("nfc_brownout", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("nfc_brownout", run) == "");
  CHECK(run.at("2.9", "sensor.led") == 1);
  CHECK(run.at("2.9", "sensor.mcu.powered") == 1);
  CHECK(run.at("4.9", "sensor.led") == 0);
  CHECK(run.at("4.9", "sensor.mcu.powered") == 0);
  CHECK(run.at("6", "sensor.mcu.powered") == 1);
  CHECK(run.at("6", "sensor.led") == 0);
  CHECK(run.at("6", "reader.messages.retries") > 0);
  CHECK(run.at("8", "reader.messages.answered") == 4);
  CHECK(run.at("8", "reader.messages.unexpected") == 0);
}

TEST_CASE("nfc_jitter: the reader begins to receive the sensor during its approach") {
  const ScenarioRun run("nfc_jitter", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("nfc_jitter", run) == "");
  CHECK(run.at("2.5", "reader.messages.sent") == 20);
  CHECK(run.at("1.6", "reader.messages.answered") == 0);
  CHECK(run.at("2.5", "reader.messages.answered") > run.at("2.1", "reader.messages.answered"));
}

TEST_CASE("nfc_jitter: the seed decides, and nothing else does") {
  const auto way = [](const std::string& seed, const std::string& step) {
    const ScenarioRun run("nfc_jitter", {"--set", "reader.seed=" + seed, "--step", step, "--stop",
                                         "1.5", "--no-trace"});
    return std::pair(run.at("0.5", "channel.distance [m]"), run.at("1.5", "channel.distance [m]"));
  };
  const auto first = way("5", "0.001");
  CHECK(way("5", "0.001") == first);
  const auto other = way("6", "0.001");
  CHECK(std::abs(other.first - first.first) > 1e-3);
  CHECK(std::abs(other.second - first.second) > 1e-4);
  // with other steps the arm's commands reach it at other grid points of its world
  const auto finer = way("5", "0.0005");
  CHECK(finer.first == Approx(first.first).margin(1e-3));
  CHECK(finer.second == Approx(first.second).margin(1e-3));
}

TEST_CASE(
    "nfc_two_tags: the reader finds the tags, and exchanges frames with the one that it has "
    "selected") {
  const ScenarioRun& run = two_tags();
  CHECK(golden_differences("nfc_two_tags", run) == "");
  CHECK(run.at("6", "reader.messages.sent") == 11);
  CHECK(run.at("6", "reader.messages.as_expected") == 11);

  // above the left sensor the right one has too little voltage to hear anything
  CHECK(run.at("3", "reader.measured.identifier") == 0x4C454654);
  CHECK(run.at("3", "reader.measured.temperature [degC]") == Approx(21.5).margin(0.1));
  CHECK(run.at("3", "sensor_left.mcu.selected") == 1);
  CHECK(run.at("3", "sensor_right.frames.rejected") == 0);
  CHECK(run.at("3", "sensor_right.frames.received") == 0);
  CHECK(run.at("3", "sensor_right.frames.sent") == 0);

  // between the two both answer
  CHECK(run.at("3.45", "sensor_left.frames.sent") == run.at("3", "sensor_left.frames.sent") + 2);
  CHECK(run.at("3.45", "sensor_right.frames.sent") == 2);
  CHECK(run.at("3.45", "reader.messages.damaged") == 1);
  CHECK(run.at("3.45", "reader.messages.unanswered") == 1);

  // until one is selected
  CHECK(run.at("3.6", "sensor_left.mcu.selected") == 0);
  CHECK(run.at("3.6", "sensor_right.mcu.selected") == 1);
  CHECK(run.at("6", "sensor_left.frames.sent") == run.at("3.45", "sensor_left.frames.sent"));
  CHECK(run.at("3.8", "reader.measured.temperature [degC]") == Approx(35.5).margin(0.1));
  CHECK(run.at("6", "reader.measured.identifier") == 0x52474854);
  CHECK(run.at("6", "reader.measured.log_size") == 1);
  CHECK(run.at("6", "sensor_right.mcu.selected") == 0);
}

TEST_CASE("nfc_two_tags: the answers that collide begin at one instant") {
  const auto left = two_tags().payloads("sensor_left", "transmit.frame", "sent");
  const auto right = two_tags().payloads("sensor_right", "transmit.frame", "sent");
  REQUIRE(left.size() == 5);
  REQUIRE(right.size() == 8);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(left[3 + i].substr(0, 16) == right[i].substr(0, 16));  // the start
    CHECK(left[3 + i] != right[i]);
  }
}

TEST_CASE("nfc_two_tags: early returns change when frames are handed over, not which") {
  const OtherEarlyReturn other(
      GENERATE("<stride:EarlyReturn components=\"*\" allowed=\"false\"/>",
               "<stride:EarlyReturn components=\"sensor_*\" allowed=\"false\"/>\n"
               "<stride:EarlyReturn components=\"sensor_right\" allowed=\"true\"/>"));
  const ScenarioRun run(other.file(), {"--no-trace", "--stop", "3.8"});
  const auto until_then = [](std::vector<std::string> all, std::size_t count) {
    REQUIRE(all.size() >= count);
    all.resize(count);
    return all;
  };
  for (const std::string sender : {"sensor_left", "sensor_right"}) {
    CHECK(run.payloads(sender, "transmit.frame", "sent") ==
          until_then(two_tags().payloads(sender, "transmit.frame", "sent"), 5));
    CHECK(run.instants(sender, "transmit.frame", "sent") !=
          until_then(two_tags().instants(sender, "transmit.frame", "sent"), 5));
  }
  CHECK(run.payloads("channel", "to_reader.frame", "sent") ==
        until_then(two_tags().payloads("channel", "to_reader.frame", "sent"), 8));
  CHECK(run.payloads("reader", "report.text", "sent") ==
        until_then(two_tags().payloads("reader", "report.text", "sent"), 7));
}

TEST_CASE("rf_approach: nearer is not better where two rays cancel, and the retries outlast it") {
  const ScenarioRun run("rf_approach", {"--no-trace", "--no-idle-skip"});
  CHECK(golden_differences("rf_approach", run) == "");
  // far away the first try is answered
  CHECK(run.at("0.5", "channel.distance [m]") == Approx(0.728).margin(1e-3));
  CHECK(run.at("0.6", "reader.messages.answered") == 1);
  CHECK(run.at("0.6", "reader.messages.retries") == 0);
  // nearer, where the paths differ by one wave, none is
  const Extremes null = run.between("3.2", "4", "channel.distance [m]");
  CHECK(null.most == Approx(0.429).margin(1e-3));
  CHECK(std::hypot(0.38, 0.4) - null.most == Approx(299792458 / 2.45e9).margin(1e-3));
  CHECK(run.between("3.2", "4", "channel.snr.down [dB]").most < -6);
  CHECK(run.at("4", "reader.messages.retries") > 10);
  CHECK(run.at("4", "reader.messages.answered") == 1);
  CHECK(run.at("4", "sensor.frames.received") == 1);
  // the arm moves on
  CHECK(run.at("4.6", "reader.messages.answered") == 2);
  CHECK(run.at("8", "reader.messages.as_expected") == 3);
  CHECK(run.at("7", "channel.snr.down [dB]") > 13);
  // all of this on the charge of the sensor's capacitor
  CHECK(run.between("0", "8", "sensor.mcu.powered").most == 1);
  CHECK(run.at("8", "sensor.capacitor.voltage [V]") > 4.1);
}

TEST_CASE("rf_approach: all along the way there are two rays between where the antennas are") {
  const ScenarioRun run("rf_approach",
                        {"--no-trace", "--no-idle-skip", "--signals", "world.site.*.position.*",
                         "--signals", "channel.coupling"});
  const auto column = [&](const std::string& name) { return run.signals().numbers(name); };
  const auto position = [&](const std::string& site, const std::string& axis) {
    return column("world.site." + site + ".position." + axis + " [m]");
  };
  const auto x = position("reader_coil", "x"), z = position("reader_coil", "z");
  const auto tag_x = position("tag_coil", "x"), tag_z = position("tag_coil", "z");
  const auto coupling = column("channel.coupling");
  // both dipoles lie across the way, and the bench turns such a field round
  const double wavelength = 299792458 / 2.45e9;
  const double gain = std::pow(10, 0.176) * wavelength / (4 * M_PI);
  REQUIRE(coupling.size() > 8000);
  double greatest = 0;
  for (std::size_t i = 0; i < coupling.size(); ++i) {
    const double direct = std::hypot(tag_x[i] - x[i], tag_z[i] - z[i]);
    const double reflected = std::hypot(tag_x[i] - x[i], tag_z[i] + z[i]);
    const std::complex<double> field =
        std::polar(1 / direct, -2 * M_PI * direct / wavelength) -
        std::polar(1 / reflected, -2 * M_PI * reflected / wavelength);
    greatest = std::max(greatest, std::abs(coupling[i] / (gain * std::abs(field)) - 1));
  }
  CHECK(greatest < 0.01);
}

TEST_CASE("a mistake in a program ends with its file and line") {
  const Outcome outcome = run_program({"run", STRIDE_SOURCE_DIR "/scenarios/nfc_far/nfc_far.ssd",
                                       "--set", "reader.program=other.xml", "--out",
                                       (fs::temp_directory_path() / "stride-none").string()});
  CHECK(outcome.exit_code != 0);
  CHECK_THAT(outcome.err, Catch::Contains("other.xml") && Catch::Contains("cannot be read"));
}
