// The sensor as a unit, driven through the kit's interface.
#ifndef STRIDE_TESTS_UNITS_SENSOR_UNIT_BENCH_H
#define STRIDE_TESTS_UNITS_SENSOR_UNIT_BENCH_H

#include <algorithm>
#include <string>
#include <vector>

#include "tests/units/sensor/bench.h"
#include "tests/units/systemc/unit_driver.h"

namespace sensor {

constexpr stride::Duration kMillisecond{1'000'000'000};

class UnitBench : public stride::tests::UnitDriver {
 public:
  UnitBench() : UnitDriver(stride::unit_factory().make({{}, "sensor"})) {
    value<double>("field_power") = kCarrier;
  }

  /// One step, and the events at its end, each message of which is kept.
  void step(stride::Time to, bool may_return_early) {
    UnitDriver::step(to, may_return_early);
    take_message();
    while (clock().ticked()) handle_event();
  }

  void run(stride::Time to, bool may_return_early, stride::Duration size = kMillisecond) {
    while (now() < to) step(std::min(to, now() + size), may_return_early);
  }

  void send(const nfc::Frame& frame) {
    value<stride::Binary>("receive.frame") = nfc::encode(frame);
    value<stride::Clock>("receive.clock").tick();
    handle_event();
  }

  double sum_of(const std::vector<std::string>& names) {
    double sum = 0;
    for (const std::string& name : names) sum += value<double>(name);
    return sum;
  }

  std::vector<nfc::Frame> answers;
  std::vector<stride::Time> received_at;

 private:
  stride::Clock& clock() { return value<stride::Clock>("transmit.clock"); }

  void handle_event() {
    clock().clear();
    event();
    value<stride::Clock>("receive.clock").clear();
    take_message();
  }

  void take_message() {
    if (!clock().ticked()) return;
    answers.push_back(nfc::decode(value<stride::Binary>("transmit.frame")));
    received_at.push_back(now());
  }
};

}  // namespace sensor

#endif
