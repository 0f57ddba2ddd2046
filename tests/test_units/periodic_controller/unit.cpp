// The PI controller on a constant clock: every 10 ms, the first time 2 ms after the start.
#include <chrono>

#include "tests/test_units/sampled_controller/pi.h"

namespace {

class PeriodicController : public stride::tests::SampledPi {
 public:
  PeriodicController() {
    using namespace std::chrono_literals;
    describe("A sampled PI controller on a constant clock");
    input("tick", clock_).every(10ms, 2ms);
    state();
  }

  void event(stride::Event&) override {
    if (clock_.ticked()) count_tick(clock_.interval());
  }
};

}  // namespace

STRIDE_UNIT(PeriodicController)
