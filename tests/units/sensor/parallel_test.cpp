// Sensors beside each other: the SystemC kernel is one per process, and still the threads of a run
// change nothing.
#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>

#include <stride/nfc/commands.h>
#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>

#include "master/base/text/hex.h"
#include "master/base/time_text.h"
#include "master/loader/fmu/fmu.h"
#include "tests/build.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

/// The bits of all recorded numbers, and all messages.
struct Trace : Observer {
  std::vector<Signal> signals;
  std::vector<std::uint64_t> words;
  std::vector<std::string> messages;

  void on_start(std::span<const Signal> all) override { signals.assign(all.begin(), all.end()); }
  void on_communication_point(Time time) override {
    words.push_back(static_cast<std::uint64_t>(time.time_since_epoch().count()));
    for (const Signal& signal : signals) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &signal.block->numbers<double>()[signal.first], sizeof bits);
      words.push_back(bits);
    }
  }
  void on_message(const Message& message) override {
    messages.push_back(to_text(message.time) + " " + std::to_string(message.id.component) +
                       (message.received ? " < " : " > ") +
                       to_hex(message.block->binaries()[message.first]));
  }
};

/// Varies the field, and sends a frame every 10 ms. Might reject a step, and can be rolled back.
void add_reader(ScriptedSystem& system, const char* name) {
  auto& reader = system.add(name, Describe("reader")
                                      .output("power", "W")
                                      .add("clock", ValueType::Clock, Causality::Output)
                                      .add("frame", ValueType::Binary, Causality::Output)
                                      .clocked_by(1)
                                      .can_save_state()
                                      .done());
  reader.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(0) = 5e-3 * (1 + std::sin(300 * to_seconds(to)));
    StepResult result = reached(to);
    if (to.time_since_epoch() % 10ms == Duration{}) {
      nfc::Frame frame;
      frame.start = to;
      frame.bits = nfc::to_bits(nfc::with_crc({static_cast<std::uint8_t>(nfc::Command::Identify)}));
      unit.binary(2) = nfc::encode(frame);
      unit.clock(1) = true;
      result.event_handling_needed = true;
    }
    return result;
  };
  reader.on_event = [](ScriptedUnit& unit) {
    unit.clock(1) = false;
    return EventResult{};
  };
}

/// A charged sensor. `may_stop` = false makes it one that answers at communication points only, so
/// that there may be several.
void add_sensor(ScriptedSystem& system, importer::Fmu& fmu, const std::string& name,
                bool may_stop) {
  auto description = std::make_shared<UnitDescription>(*fmu.description());
  description->may_return_early = may_stop;
  importer::InstanceOptions options;
  options.early_return_allowed = may_stop;
  system.declaration.components.push_back({name, description, {}, {}});
  system.declaration.start_values.push_back({name, "power.initial_voltage", "4", "", {}});
  system.units.push_back(fmu.instantiate(name, options));
  system.wire("reader", "power", name, "field_power");
  system.wire("reader", "clock", name, "receive.clock");
  system.wire("reader", "frame", name, "receive.frame");
}

Trace run(std::size_t sensors, bool may_stop, ThreadOptions threads) {
  const auto fmu = importer::Fmu::load(tests::unit_library("sensor"));
  ScriptedSystem system;
  add_reader(system, "reader");
  std::vector<VariableId> recorded;
  for (std::size_t i = 1; i <= sensors; ++i) {
    add_sensor(system, *fmu, "sensor" + std::to_string(i), may_stop);
    for (const char* name : {"capacitor.voltage", "energy.load", "energy.intake"}) {
      recorded.push_back({i, *fmu->description()->find(name)});
    }
  }
  // so that two step at the same time, before the one that cannot be rolled back
  if (may_stop) add_reader(system, "other reader");
  system.options.threads = std::move(threads);
  Trace trace;
  system.build(0.05, 500us, recorded).add_observer(trace);
  system.simulation->run();
  const auto& statistics = system.simulation->statistics();
  CHECK((statistics.parallel_steps == statistics.communication_steps) ==
        system.options.threads.always);
  return trace;
}

}  // namespace

TEST_CASE("sensors that step at the same time give the same bits and messages as in turn") {
  const std::size_t sensors = 3;
  const Trace serial = run(sensors, false, {});
  CHECK(serial.messages.size() == 5 + 5 * sensors + 4 * sensors);  // the last has no time to answer
  for (const std::size_t threads : {2, 4}) {
    const Trace parallel = run(sensors, false, {threads, {}, true});
    CHECK(parallel.words == serial.words);
    CHECK(parallel.messages == serial.messages);
  }
}

TEST_CASE("a sensor that stops early steps after units that can be rolled back, at the same time") {
  const Trace serial = run(1, true, {});
  const Trace parallel = run(1, true, {2, {}, true});
  CHECK(serial.words.size() / 4 > 101);  // its answers stand at their own instants
  CHECK(parallel.words == serial.words);
  CHECK(parallel.messages == serial.messages);
}
