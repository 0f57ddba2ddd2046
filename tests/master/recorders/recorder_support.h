// A run for recorders, by hand: the signals of component "a" of sample_system().
#ifndef STRIDE_TESTS_MASTER_RECORDERS_RECORDER_SUPPORT_H
#define STRIDE_TESTS_MASTER_RECORDERS_RECORDER_SUPPORT_H

#include <string>
#include <vector>

#include "master/algorithm/observer.h"
#include "tests/master/ssp/support.h"

namespace stride::tests {

inline Time milliseconds(std::int64_t count) { return Time(std::chrono::milliseconds(count)); }

struct SampleRun {
  core::System system = sample_system();
  core::ValueBlock numbers{core::ValueType::Float64, 5};  ///< position, then distance twice
  core::ValueBlock led{core::ValueType::Boolean, 1};
  core::ValueBlock count{core::ValueType::Int32, 1};
  core::ValueBlock label{core::ValueType::String, 1};
  core::ValueBlock digest{core::ValueType::Binary, 1};
  core::ValueBlock frame{core::ValueType::Binary, 1};

  std::vector<core::Signal> signals() const {
    return {{{0, 1}, &numbers, 3}, {{0, 2}, &led, 0},   {{0, 3}, &count, 0},
            {{0, 4}, &numbers, 0}, {{0, 5}, &label, 0}, {{0, 6}, &digest, 0},
            {{1, 1}, &numbers, 4}};
  }
  core::Message frame_at(Time time, bool received, std::size_t component, std::uint32_t index = 0) {
    return {time, index, {component, 8}, received, &frame, 0};
  }
  core::Message tick_at(Time time) { return {time, 0, {0, 9}, false, nullptr, 0}; }

  void set_first() {
    numbers.numbers<double>()[0] = 1;
    numbers.numbers<double>()[1] = -0.5;
    numbers.numbers<double>()[2] = 1e-9;
    numbers.numbers<double>()[3] = 0.1;
    label.strings()[0] = "a \"b\"\\";
    digest.binaries()[0] = {0x0a, 0xff};
  }
  void set_second() {
    numbers.numbers<double>()[3] = 0.30000000000000004;
    led.numbers<bool>()[0] = true;
    count.numbers<std::int32_t>()[0] = -3;
    label.strings()[0] = "";
  }
};

}  // namespace stride::tests

#endif
