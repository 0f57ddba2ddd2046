// Another channel in a scenario's place: by the program's option, or by one attribute.
#include <fstream>

#include <catch2/catch.hpp>

#include "tests/golden/scenario_run.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

/// A scenario of this project with another unit as its channel, beside what it refers to.
class OtherChannel {
 public:
  OtherChannel(const std::string& scenario, const std::string& unit) {
    std::string text = text_of(scenario_folder(scenario) / (scenario + ".ssd"));
    const std::string before = "source=\"nfc_channel.fmu\"";
    const std::size_t at = text.find(before);
    if (at == std::string::npos) throw std::runtime_error("no channel in " + scenario);
    text.replace(at, before.size(), "source=\"" + unit + ".fmu\"");
    fs::create_directory(folder_ / scenario);
    std::ofstream(folder_ / scenario / "other.ssd") << text;
    fs::create_directory(folder_ / "nfc_approach");
    for (const char* parameters : {"sensor.ssv", "ground_truth.ssv"}) {
      fs::copy_file(scenario_folder("nfc_approach") / parameters,
                    folder_ / "nfc_approach" / parameters);
    }
    file_ = (folder_ / scenario / "other.ssd").string();
  }

  const std::string& file() const { return file_; }

 private:
  ScratchFolder folder_;
  std::string file_;
};

}  // namespace

TEST_CASE("another channel by --swap and by an edited attribute gives the same bytes") {
  const std::string unit = GENERATE("rf_channel", "ideal_channel");
  const std::string scenario = GENERATE("nfc_approach", "nfc_far");
  INFO(unit << " in " << scenario);
  Arguments further = without_judge(scenario);
  further.insert(further.end(), {"--no-trace", "--no-checks", "--stop", "9"});
  Arguments swapping = further;
  swapping.insert(swapping.end(), {"--swap", "channel=" + unit + ".fmu"});
  const ScenarioRun swapped(scenario, swapping);
  const OtherChannel other(scenario, unit);
  const ScenarioRun edited(other.file(), further);
  const ScenarioRun original(scenario, further);
  for (const char* file : {"signals.csv", "events.csv"}) {
    INFO(file);
    const std::string text = text_of(swapped.file(file));
    CHECK(text.size() > 500);
    CHECK(text == text_of(edited.file(file)));
    CHECK(text != text_of(original.file(file)));
  }
  CHECK(swapped.signals().titles() == original.signals().titles());
}

TEST_CASE("over an ideal channel the reader that is too far away is answered at once") {
  const ScenarioRun run("nfc_far",
                        {"--no-trace", "--no-checks", "--swap", "channel=ideal_channel.fmu"});
  CHECK(run.at("10", "reader.messages.answered") == 3);
  CHECK(run.at("10", "reader.messages.retries") == 0);
  CHECK(run.between("0", "10", "channel.tag_power [W]").most == 5e-3);
}

TEST_CASE(
    "over a packet radio an NFC sensor receives every request, and has no carrier for an answer") {
  const ScenarioRun run("nfc_far",
                        {"--no-trace", "--no-checks", "--swap", "channel=rf_channel.fmu"});
  CHECK(run.at("10", "sensor.frames.received") == 11);
  CHECK(run.at("10", "sensor.frames.dropped") == 11);
  CHECK(run.at("10", "reader.messages.answered") == 0);
  CHECK(run.between("0", "10", "channel.tag_power [W]").most == 0);
}

TEST_CASE("with a carrier of its own the NFC sensor answers over a packet radio") {
  const ScenarioRun run("nfc_far", {"--no-trace", "--no-checks", "--swap", "channel=rf_channel.fmu",
                                    "--set", "sensor.transceiver.carrier_voltage=0"});
  CHECK(run.at("10", "reader.messages.answered") == 3);
  CHECK(run.at("10", "reader.messages.retries") == 0);
}
