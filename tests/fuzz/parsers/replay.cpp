// Captured stimuli of a campaign, and the results of its cases, of which a suite is made.
#include "master/observe/capture/unended_stimuli.h"
#include "master/study/replay/device_record.h"
#include "master/study/replay/stimuli_summary.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

namespace fs = std::filesystem;

/// As a case may have left them whose process was killed.
void read_captured(const std::string& bytes) {
  const fs::path file = write_file("captured.csv", bytes);
  refusing_input(file.string(), [&] {
    if (!capture::end_stimuli(file, "failed: it was killed")) throw Refusal("it has no step");
    const std::string part = replay::repeated_part(file);
    const replay::StimuliSummary found = replay::summarise_stimuli(file);
    ensure(found.instants.contains(found.end), "the end is one of the instants");
    ensure(capture::end_stimuli(file, "another") && replay::repeated_part(file) == part,
           "a file is ended once");
  });
}

core::UnitDescription sensor() {
  core::UnitDescription device;
  for (const char* name : {"led", "mcu.awake", "supply.voltage", "adc.value"}) {
    core::Variable& output = device.variables.emplace_back();
    output.name = name;
    output.causality = core::Causality::Output;
  }
  device.variables[2].unit = "V";
  return device;
}

void read_results(const fs::path& signals, const fs::path& events) {
  refusing_input((signals.empty() ? events : signals).string(), [&] {
    const replay::DeviceRecord record =
        replay::read_device_record(signals, events, "sensor", sensor());
    ensure(record.times.size() == record.values.size(), "each time is there once");
    for (const auto& [time, row] : record.values) {
      ensure(row.size() == record.outputs.size(), "each time has all outputs");
    }
    replay::StimuliSummary everywhere;
    everywhere.instants.insert(record.times.begin(), record.times.end());
    everywhere.end = "inf";
    ensure(!replay::first_difference(record, record, everywhere), "a record is like itself");
    replay::expectations_of(record, sensor(), "");
  });
}

const Registration kReplayParsers(
    "replay",
    {
        {.name = "captured_stimuli",
         .read = read_captured,
         .seed_files = {"tests/fuzz/seeds/stimuli", "units/player/resources/stimuli.csv",
                        "scenarios/replay_sensor/player/stimuli.csv"},
         .alphabet = ",\"\n.0123456789-stepnd"},
        {.name = "device_signals",
         .read =
             [](const std::string& bytes) { read_results(write_file("signals.csv", bytes), {}); },
         .seed_files = {"scenarios/replay_sensor/golden/signals.csv"},
         .alphabet = ",\"\n.0123456789-"},
        {.name = "device_events",
         .read =
             [](const std::string& bytes) { read_results({}, write_file("events.csv", bytes)); },
         .seed_files = {"scenarios/replay_sensor/golden/events.csv"},
         .alphabet = ",\"\n.0123456789-"},
    });

}  // namespace
}  // namespace stride::tests
