// The tutorial unit: a first-order low-pass, time_constant * dy/dt = u - y, made into an FMU by the
// unit kit.
#include <cmath>

#include <stride/unit.h>

class LowPass : public stride::Unit {
 public:
  // The constructor lists the variables. A variable is bound to a member, and what the member holds
  // now is its start value. state() declares that the variables are all there is to save, so the
  // unit can be rolled back.
  LowPass() {
    describe("First-order low-pass filter: the unit kit's tutorial");
    input("u", u_).description("signal");
    output("y", y_).exact().depends_on({}).derivative(rate_).description("filtered signal");
    parameter("time_constant", time_constant_).unit("s").min(1e-9).description("1/e settling time");
    state(rate_);
  }

  // One communication step. Inputs are in their members; outputs are read from theirs afterwards.
  // The exact solution for an input that is held over the step, so two half steps give the same as
  // one.
  void step(stride::Step& step) override {
    const double decay = std::exp(-stride::to_seconds(step.size()) / time_constant_);
    y_ = u_ + (y_ - u_) * decay;
    update_outputs();
  }

  // What follows from the inputs at once: asked for at the start, too, and where inputs change
  // between two steps.
  void update_outputs() override { rate_ = (u_ - y_) / time_constant_; }

 private:
  double u_ = 0;
  double y_ = 0;
  double rate_ = 0;
  double time_constant_ = 1;
};

STRIDE_UNIT(LowPass)
