// Half of an oscillator of two masses:
//
//   m * a = -k * x - d * v + kc * (x_other - x) + dc * (v_other - v)
//
// Two instances, each with the displacement and the velocity of the other as its inputs, are the
// whole. It integrates by the classical Runge-Kutta method of fourth order, in equal steps of
// `largest_step` at most, and asks for its inputs at each stage.
#include <cmath>

#include <stride/unit.h>

namespace {

class OscillatorMass : public stride::Unit {
 public:
  OscillatorMass() {
    describe("A mass on a spring and a damper, coupled to another by a spring and a damper");
    parameter("mass", mass_).unit("kg").min(1e-9);
    parameter("stiffness", stiffness_).unit("N/m").description("to the ground");
    parameter("damping", damping_).unit("N.s/m").description("to the ground");
    parameter("coupling_stiffness", coupling_stiffness_).unit("N/m");
    parameter("coupling_damping", coupling_damping_).unit("N.s/m");
    parameter("start_displacement", start_.x).unit("m");
    parameter("start_velocity", start_.v).unit("m/s");
    parameter("largest_step", largest_step_).unit("s").min(1e-9);
    input("x_other", other_.x).unit("m").intermediate();
    input("v_other", other_.v).unit("m/s").intermediate();
    output("x", now_.x).unit("m").depends_on({}).derivative(now_.v);
    output("v", now_.v).unit("m/s").depends_on({}).derivative(acceleration_);
    state(acceleration_);
  }

  void initialize(stride::Time) override {
    now_ = start_;
    update_outputs();
  }

  void step(stride::Step& step) override {
    const double size = stride::to_seconds(step.size());
    const int count = static_cast<int>(std::ceil(size / largest_step_ * (1 - 1e-12)));
    const double h = size / count;
    for (int i = 0; i < count; ++i) integrate(step, i * h, h);
    step.update_inputs(size);
    update_outputs();
  }

  void update_outputs() override { acceleration_ = derivative(now_).v; }

 private:
  struct State {
    double x = 0;
    double v = 0;
    State plus(double h, const State& rate) const { return {x + h * rate.x, v + h * rate.v}; }
  };

  void integrate(const stride::Step& step, double at, double h) {
    step.update_inputs(at);
    const State k1 = derivative(now_);
    step.update_inputs(at + h / 2);
    const State k2 = derivative(now_.plus(h / 2, k1));
    const State k3 = derivative(now_.plus(h / 2, k2));
    step.update_inputs(at + h);
    const State k4 = derivative(now_.plus(h, k3));
    now_ = now_.plus(h / 6, k1).plus(h / 3, k2).plus(h / 3, k3).plus(h / 6, k4);
  }

  State derivative(const State& state) const {
    const double force = -stiffness_ * state.x - damping_ * state.v +
                         coupling_stiffness_ * (other_.x - state.x) +
                         coupling_damping_ * (other_.v - state.v);
    return {state.v, force / mass_};
  }

  double mass_ = 1;
  double stiffness_ = 10;
  double damping_ = 0.1;
  double coupling_stiffness_ = 5;
  double coupling_damping_ = 0.1;
  double largest_step_ = 1e-3;
  State start_{1, 0};
  State now_;
  State other_;
  double acceleration_ = 0;
};

}  // namespace

STRIDE_UNIT(OscillatorMass)
