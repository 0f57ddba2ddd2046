// A simulation of a sensor, and the settings that must not change its results.
#ifndef STRIDE_TESTS_UNITS_SENSOR_SIMULATED_SENSOR_H
#define STRIDE_TESTS_UNITS_SENSOR_SIMULATED_SENSOR_H

#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "tests/units/sensor/unit_bench.h"

namespace sensor {

constexpr stride::Duration kSecond = 1000 * kMillisecond;

/// How a sensor is simulated. None of it may change a result.
struct SensorSettings {
  bool gating = true;
  std::optional<stride::Duration> max_skip;
  std::string trace_file;
  double frequency = 2e6;  ///< [Hz]
};

/// With a slow clock, so that one without a gate can be simulated, and energy for minutes.
inline void prepare(UnitBench& bench, const SensorSettings& settings) {
  bench.value<double>("power.initial_voltage") = 4.0;
  bench.value<double>("power.capacitance") = 2e-3;
  bench.value<double>("control_unit.clock_frequency") = settings.frequency;
  bench.value<bool>("control_unit.clock_gating") = settings.gating;
  bench.value<std::string>("trace.file") = settings.trace_file;
  if (settings.max_skip) bench.enable_skipping(*settings.max_skip);
  bench.initialize(stride::Time(7 * kMillisecond));
}

/// The bits of all numbers that are outputs.
inline std::vector<std::uint64_t> outputs(UnitBench& bench) {
  std::vector<std::uint64_t> words;
  for (const stride::Variable& row : bench.unit().variables()) {
    if (row.causality != stride::Causality::Output) continue;
    const std::size_t size = row.type == stride::Type::Float64   ? 8
                             : row.type == stride::Type::Int32   ? 4
                             : row.type == stride::Type::Boolean ? 1
                                                                 : 0;
    std::uint64_t word = 0;
    std::memcpy(&word, row.data, size);
    words.push_back(word);
  }
  return words;
}

const nfc::Bytes kCommands[] = {
    {0x01}, {0x02}, {0x03, 0x01}, {0x03, 0x00}, {0x05}, {0x06, 0x00, 0x01}, {0x06, 0x00, 0x02},
    {0x07}, {0x7F}};
const double kFields[] = {0.0, kCarrier, 0.19e-3, 20e-3};

struct Record {
  std::vector<nfc::Frame> answers;
  std::vector<stride::Time> received_at;
  std::vector<std::vector<std::uint64_t>> outputs;  ///< at the communication points
};

/// Commands, fields and temperatures at seeded instants, for two and a half seconds or more.
inline Record simulate(UnitBench& bench, unsigned seed) {
  std::mt19937 random(seed);  // its sequence is part of the C++ standard
  Record record;
  const stride::Time end = bench.now() + 5 * kSecond / 2;
  while (bench.now() < end) {
    const stride::Duration pause(1 + static_cast<std::int64_t>(random()) *
                                         (random() % 4 == 0 ? 80 : 3));
    bench.run(bench.now() + pause, true,
              static_cast<std::int64_t>(1 + random() % 40) * kMillisecond);
    record.outputs.push_back(outputs(bench));
    if (random() % 3 == 0) bench.value<double>("field_power") = kFields[random() % 4];
    bench.value<double>("adc.temperature") = static_cast<double>(random() % 60);
    if (random() % 4 != 0) {
      const nfc::Frame frame = request(kCommands[random() % 9], bench.now());
      bench.run(frame.start + nfc::air_time(frame), true);
      bench.send(frame);
    }
  }
  record.answers = bench.answers;
  record.received_at = bench.received_at;
  return record;
}

inline Record simulate(const SensorSettings& settings, unsigned seed) {
  UnitBench bench;
  prepare(bench, settings);
  Record record = simulate(bench, seed);
  bench.unit().terminate();
  return record;
}

}  // namespace sensor

#endif
