// What the smaller scenarios are there to show, whatever the exact numbers are.
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include "tests/cli/program.h"
#include "tests/cli/results.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

/// One run of a scenario, in a folder that goes with the object.
class Run {
 public:
  explicit Run(const std::string& scenario, const Arguments& further = {}) {
    std::string name = (fs::temp_directory_path() / "stride-outcomes-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    const std::string file = STRIDE_SOURCE_DIR "/scenarios/" + scenario + "/" + scenario + ".ssd";
    Arguments arguments{"run", file, "--out", name, "--quiet", "--no-trace"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const Outcome outcome = run_program(arguments);
    if (outcome.exit_code != 0) throw std::runtime_error("the run failed: " + outcome.err);
    signals_ = Csv(folder_ / "signals.csv");
  }
  ~Run() { fs::remove_all(folder_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  double at(const std::string& time, const std::string& signal) const {
    return signals_->number(signals_->row_at(time), signals_->column(signal));
  }
  fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_;
  std::optional<Csv> signals_;
};

}  // namespace

TEST_CASE("nfc_far: nobody is heard, as the program expects") {
  const Run run("nfc_far");
  CHECK(run.at("10", "reader.messages.sent") == 3);
  CHECK(run.at("10", "reader.messages.retries") == 8);
  CHECK(run.at("10", "reader.messages.answered") == 0);
  CHECK(run.at("10", "reader.messages.unexpected") == 0);
}

TEST_CASE("nfc_brownout: the sensor goes off with its LED on, and comes back") {
  const Run run("nfc_brownout");
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

TEST_CASE("nfc_jitter: the seed decides, and nothing else does") {
  const auto way = [](const std::string& seed, const std::string& step) {
    const Run run("nfc_jitter", {"--set", "reader.seed=" + seed, "--step", step, "--stop", "1.5"});
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

TEST_CASE("a mistake in a program ends with its file and line") {
  const Outcome outcome = run_program({"run", STRIDE_SOURCE_DIR "/scenarios/nfc_far/nfc_far.ssd",
                                       "--set", "reader.program=other.xml", "--out",
                                       (fs::temp_directory_path() / "stride-none").string()});
  CHECK(outcome.exit_code != 0);
  CHECK_THAT(outcome.err, Catch::Contains("other.xml") && Catch::Contains("cannot be read"));
}
