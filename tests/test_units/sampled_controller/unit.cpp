// A PI controller on a countdown clock. Its period is an input, and may change while it runs: the
// next tick comes one new period after the change.
#include "tests/test_units/sampled_controller/pi.h"

namespace {

using stride::Duration;

class SampledController : public stride::tests::SampledPi {
 public:
  SampledController() {
    describe("A sampled PI controller on a countdown clock");
    input("tick", clock_).countdown();
    input("period", period_).unit("s").discrete().min(1e-12);
    parameter("shift", shift_).unit("s").min(0).description("from the start to the first tick");
    state(counted_);
  }

  void initialize(stride::Time start) override {
    SampledPi::initialize(start);
    counted_ = stride::duration_from_seconds(period_);
    clock_.count_down(stride::duration_from_seconds(shift_));
  }

  void event(stride::Event&) override {
    const Duration period = stride::duration_from_seconds(period_);
    const bool has_ticked = clock_.ticked();
    if (has_ticked) count_tick(period);
    if (has_ticked || period != counted_) clock_.count_down(period);
    counted_ = period;
  }

 private:
  double period_ = 0.01;
  double shift_ = 0;
  Duration counted_{};  ///< the period that is counted down
};

}  // namespace

STRIDE_UNIT(SampledController)
