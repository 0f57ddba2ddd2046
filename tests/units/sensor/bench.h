// A sensor on the bench: what a test needs to drive it.
#ifndef STRIDE_TESTS_UNITS_SENSOR_BENCH_H
#define STRIDE_TESTS_UNITS_SENSOR_BENCH_H

#include <optional>
#include <vector>

#include <stride/nfc/iso14443a.h>
#include <stride/systemc/device.h>

#include "units/sensor/sensor.h"

namespace sensor {

inline stride::Time ms(double milliseconds) {
  return stride::time_from_seconds(milliseconds * 1e-3);
}

inline nfc::Frame request(const nfc::Bytes& data, stride::Time start) {
  nfc::Frame frame;
  frame.start = start;
  frame.bits = nfc::to_bits(nfc::with_crc(data));
  return frame;
}

/// The data of an answer; nothing if its parity or CRC is wrong.
inline std::optional<nfc::Bytes> data_of(const nfc::Frame& frame) {
  const auto bytes = nfc::to_bytes(frame.bits);
  return bytes ? nfc::without_crc(*bytes) : std::nullopt;
}

/// Full, so it is powered at once and has booted after a millisecond.
inline SensorParameters charged() {
  SensorParameters parameters;
  parameters.power.initial_voltage = 4.0;
  return parameters;
}

/// A field that can be answered with: 3.7 V at the antenna, too little to charge anything.
constexpr double kCarrier = 90e-6;

/// The field with which the rectifier gives this current [A] at this voltage of the rail.
inline double field_for(const PowerParameters& power, double current, double rail = 5.0) {
  const double amplitude = rail + power.rectifier_drop + 2 * power.antenna_resistance * current;
  return amplitude * amplitude / (8 * power.antenna_resistance);
}

class Bench {
 public:
  explicit Bench(const SensorParameters& parameters = charged())
      : device({}, "sensor", parameters) {
    device.within([this](Sensor& sensor) {
      sensor.temperature.write(20.0);
      sensor.field_power.write(kCarrier);
      sensor.transceiver.on_transmit = [this](const nfc::Frame& f) { answers.push_back(f); };
    });
  }

  void field(double watts) {
    device.within([=](Sensor& sensor) { sensor.field_power.write(watts); });
  }
  void temperature(double celsius) {
    device.within([=](Sensor& sensor) { sensor.temperature.write(celsius); });
  }
  /// Now, whatever its start is.
  void arrive(const nfc::Frame& frame) {
    device.within([&](Sensor& sensor) { sensor.transceiver.arrive(frame); });
  }
  void send(const nfc::Bytes& data, stride::Time start) { arrive(request(data, start)); }
  /// Runs to the end of a request, where the channel hands it over, and a millisecond further.
  void ask(const nfc::Bytes& data, stride::Time start) {
    const nfc::Frame frame = request(data, start);
    const stride::Time end = frame.start + nfc::air_time(frame);
    run(end);
    arrive(frame);
    run(end + ms(1).time_since_epoch());
  }
  void run(stride::Time to) { device.advance(to); }

  template <class Function>
  auto read(Function f) {
    return device.within([&](Sensor& sensor) { return f(sensor); });
  }
  FrameCounters frames() {
    return read([](Sensor& sensor) { return sensor.transceiver.counters(); });
  }
  bool powered() {
    return read([](Sensor& sensor) { return sensor.powered.read(); });
  }
  bool awake() {
    return read([](Sensor& sensor) { return sensor.awake.read(); });
  }
  bool led() {
    return read([](Sensor& sensor) { return sensor.led.read(); });
  }
  double voltage() {
    return read([](Sensor& sensor) { return sensor.power_unit.terminal_voltage_now(); });
  }

  stride::systemc::Device<Sensor> device;
  std::vector<nfc::Frame> answers;
};

}  // namespace sensor

#endif
