// A sampled PI controller: at tick k
//
//   u[k] = gain * e[k] + i[k],   i[k+1] = i[k] + gain * period / reset_time * e[k],   e = r - y
//
// with the time `period` to the next tick.
#ifndef STRIDE_TESTS_TEST_UNITS_SAMPLED_CONTROLLER_PI_H
#define STRIDE_TESTS_TEST_UNITS_SAMPLED_CONTROLLER_PI_H

#include <cstdint>

#include <stride/unit.h>

namespace stride::tests {

/// All but the clock, which a derived class lists and makes tick.
class SampledPi : public Unit {
 public:
  void initialize(Time start) override {
    integral_ = start_integral_;
    output_ = start_integral_;
    ticks_ = 0;
    last_tick_ = -1;
    now_ = to_seconds(start);
  }

  void step(Step& step) override { now_ = to_seconds(step.to()); }

  void update_outputs() override {
    if (!clock_.ticked()) return;
    output_ = gain_ * error() + integral_;
    last_tick_ = now_;
  }

 protected:
  SampledPi() {
    input("r", reference_).clocked_by(clock_).description("set point");
    input("y", measured_).clocked_by(clock_).description("what is controlled");
    output("u", output_).clocked_by(clock_).depends_on({"r", "y"});
    output("last_tick", last_tick_).unit("s").clocked_by(clock_).depends_on({});
    output("ticks", ticks_).depends_on({});
    parameter("gain", gain_);
    parameter("reset_time", reset_time_).unit("s").min(1e-9);
    parameter("start_integral", start_integral_);
    state(integral_, now_);
  }

  /// To be called in event(): `period` until the next tick.
  void count_tick(Duration period) {
    integral_ += gain_ * to_seconds(period) / reset_time_ * error();
    ++ticks_;
  }

  Clock clock_;

 private:
  double error() const { return reference_ - measured_; }

  double reference_ = 0;
  double measured_ = 0;
  double output_ = 0;
  double gain_ = 1;
  double reset_time_ = 1e9;
  double start_integral_ = 0;
  double integral_ = 0;
  double last_tick_ = -1;
  double now_ = 0;
  std::int32_t ticks_ = 0;
};

}  // namespace stride::tests

#endif
