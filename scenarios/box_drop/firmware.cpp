#include <algorithm>
#include <cstdlib>

#include <stride/unit.h>

class Firmware : public stride::Unit {
 public:
  Firmware() {
    describe("What the processor beside the accelerometer makes of its shocks");
    input("irq", irq_);
    input("shock.clock", clock_);
    input("shock.samples", samples_).clocked_by(clock_);
    output("awake", awake_).description("irq has been raised, and its record has not come yet");
    output("shocks", shocks_).description("how many have been recorded");
    output("peak", peak_).unit("m/s2").discrete().description("of the greatest one");
    state();
  }

  void initialize(stride::Time) override { awake_ = false, shocks_ = 0, peak_ = 0; }
  void step(stride::Step&) override {}
  void event(stride::Event&) override {
    awake_ = irq_;
    if (!clock_.ticked()) return;
    ++shocks_;
    for (std::size_t i = 0; i + 1 < samples_.size(); i += 2) {
      const auto sample = static_cast<std::int16_t>(samples_[i] << 8 | samples_[i + 1]);
      peak_ = std::max(peak_, std::abs(sample) * 9.81 / 256);
    }
  }

 private:
  bool irq_ = false, awake_ = false;
  stride::Clock clock_;
  stride::Binary samples_;
  std::uint32_t shocks_ = 0;
  double peak_ = 0;
};

STRIDE_UNIT(Firmware)
