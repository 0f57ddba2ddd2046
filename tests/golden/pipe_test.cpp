// nfc_pipe: the sensor in a program of its own, behind tags on a pipe, does what the sensor does in
// process, bit by bit.
#include <algorithm>
#include <filesystem>

#include <catch2/catch.hpp>

#include "master/loader/fmu/fmu.h"
#include "tests/build.h"
#include "tests/golden/scenario_run.h"

using namespace stride::tests;

namespace {

constexpr const char* kStop =
    "15.2";  // two requests with wrong bits or none, an answer, a brown-out
constexpr std::size_t kAnswers = 1;

Arguments options() {
  Arguments arguments = {"--set", "sensor.trace.file=sensor.vcd", "--set",
                         "sensor.trace.signals=recData DataUCToTrm Charge awake"};
  for (const std::string& word : without_judge("nfc_pipe")) arguments.push_back(word);
  for (const char* word : {"--stop", kStop, "--no-trace", "--no-idle-skip"})
    arguments.push_back(word);
  return arguments;
}

/// The file without its head, in which is the date.
std::string changes(const ScenarioRun& run) {
  const std::string text = text_of(run.file("units/sensor/sensor.vcd"));
  return text.substr(text.find("$enddefinitions"));
}

}  // namespace

TEST_CASE("what is declared of the program is what the unit sensor has") {
  const std::filesystem::path units = unit_folder();
  const auto piped = stride::importer::Fmu::load(units / "nfc_pipe_sensor.fmu")->description();
  const auto sensor = stride::importer::Fmu::load(units / "sensor.fmu")->description();
  std::size_t count = 0;
  for (const stride::core::Variable& variable : piped->variables) {
    const bool is_own = variable.name.rfind("process.", 0) == 0 || variable.name == "trace.file";
    if (is_own) continue;
    INFO(variable.name);
    const auto& all = sensor->variables;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const auto& other) { return other.name == variable.name; });
    REQUIRE(same != all.end());
    CHECK(same->type == variable.type);
    CHECK(same->causality == variable.causality);
    CHECK(same->variability == variable.variability);
    CHECK(same->unit == variable.unit);
    CHECK(same->start == variable.start);
    CHECK(same->min == variable.min);
    CHECK(same->max == variable.max);
    ++count;
  }
  CHECK(count > 50);
}

TEST_CASE("nfc_pipe: the same frames at the same instants, the same values, and the same trace") {
  const ScenarioRun piped("nfc_pipe", options());
  const ScenarioRun in_process("nfc_approach", options());
  const auto sent = piped.payloads("sensor", "transmit.frame", "sent");
  CHECK(sent.size() == kAnswers);
  CHECK(piped.instants("sensor", "transmit.frame", "sent") ==
        in_process.instants("sensor", "transmit.frame", "sent"));
  const bool same_events =
      text_of(piped.file("events.csv")) == text_of(in_process.file("events.csv"));
  const bool same_signals =
      text_of(piped.file("signals.csv")) == text_of(in_process.file("signals.csv"));
  CHECK(same_events);
  CHECK(same_signals);
  const bool same_traces = changes(piped) == changes(in_process);
  CHECK(same_traces);
}
