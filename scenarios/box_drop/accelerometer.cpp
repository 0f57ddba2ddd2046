#include "accelerometer.h"

#include <algorithm>
#include <chrono>

#include <stride/systemc/module_unit.h>

using namespace std::chrono_literals;

// a shock as bytes: 32 numbers of two bytes, the high one first
template <>
struct stride::systemc::Message<shock> {
  static Binary encode(const shock& shock) {
    Binary bytes;
    for (const auto& sample : shock.sample) {
      bytes.push_back(static_cast<std::uint8_t>(sample.to_int() >> 8));
      bytes.push_back(static_cast<std::uint8_t>(sample.to_int()));
    }
    return bytes;
  }
};

class AccelerometerUnit : public stride::systemc::ModuleUnit<accelerometer> {
 public:
  AccelerometerUnit()
      : ModuleUnit("accelerometer", "An accelerometer with a threshold interrupt and a FIFO") {
    parameter("threshold", threshold_).description("of the interrupt, in g");
    construct(threshold_);

    clock(&accelerometer::clk, 1us);
    reset(&accelerometer::rst_n, 10us, false);
    input("acceleration", &accelerometer::acceleration).unit("m/s2");
    output("code", &accelerometer::code).description("the last sample, in 1/256 g");
    output("irq", &accelerometer::irq).stop_on_change().description("a shock is being recorded");
    message_output("shock.samples", &accelerometer::shocks)
        .description("what the FIFO holds when it is written");

    idle_when(&AccelerometerUnit::is_settled, stride::systemc::repeats_every(1ms));
  }

 private:
  static bool is_settled(const accelerometer& chip) {
    const auto& samples = chip.fifo.sample;
    return !chip.irq.read() &&
           std::all_of(samples, samples + 32, [&](auto& s) { return s == chip.converted(); });
  }

  double threshold_ = 3;
};

STRIDE_UNIT(AccelerometerUnit)
