// A mass on a spring without friction; the exact solution, so it may be stepped as one likes.
#include <cmath>

#include <stride/unit.h>

class Oscillator : public stride::Unit {
 public:
  Oscillator() {
    describe("A mass on a spring without friction");
    output("position", position_).unit("m").exact().depends_on({}).derivative(velocity_);
    parameter("frequency", frequency_).unit("Hz").min(0).description("undamped");
    state(velocity_);
  }

  void step(stride::Step& step) override {
    constexpr double kTwoPi = 6.283185307179586;
    const double omega = kTwoPi * frequency_;
    const double angle = omega * stride::to_seconds(step.size());
    const double before = position_;
    position_ = before * std::cos(angle) + velocity_ / omega * std::sin(angle);
    velocity_ = velocity_ * std::cos(angle) - before * omega * std::sin(angle);
  }

 private:
  double position_ = 1;
  double velocity_ = 0;
  double frequency_ = 0.5;
};

STRIDE_UNIT(Oscillator)
