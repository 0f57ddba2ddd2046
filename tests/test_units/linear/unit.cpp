// A linear system with two states, x' = A x + b u with A = [-d -w; w -d] and b = [1; 0], written as
// one complex state: z' = c z + u with c = -d + iw. The step is the exact solution for an input
// that is held, z <- exp(ch) z + u h (exp(ch) - 1) / (ch), so a step may be split anywhere.
#include <cmath>
#include <complex>

#include <stride/unit.h>

namespace {

using Complex = std::complex<double>;

/// exp(z) - 1, exact also near 0.
Complex exp_minus_1(Complex z) {
  const double half_sine = std::sin(z.imag() / 2);
  return {std::expm1(z.real()) * std::cos(z.imag()) - 2 * half_sine * half_sine,
          std::exp(z.real()) * std::sin(z.imag())};
}

class Linear : public stride::Unit {
 public:
  Linear() {
    describe("Damped rotation of (x, y), driven by u").split_invariant = true;
    input("u", u_);
    output("x", x_).exact().depends_on({}).derivative(x_rate_);
    output("y", y_).exact().depends_on({}).derivative(y_rate_);
    parameter("damping", damping_).unit("1/s").min(0);
    parameter("frequency", frequency_).unit("rad/s");
    state(x_rate_, y_rate_);
  }

  void step(stride::Step& step) override {
    const double h = stride::to_seconds(step.size());
    const Complex ch = h * coefficient();
    const Complex grown = exp_minus_1(ch);
    const Complex z(x_, y_);
    const Complex next = z + grown * z + u_ * h * (ch == 0.0 ? Complex(1) : grown / ch);
    x_ = next.real();
    y_ = next.imag();
    update_outputs();
  }

  void update_outputs() override {
    const Complex rate = coefficient() * Complex(x_, y_) + u_;
    x_rate_ = rate.real();
    y_rate_ = rate.imag();
  }

 private:
  Complex coefficient() const { return {-damping_, frequency_}; }

  double u_ = 0;
  double x_ = 1;
  double y_ = 0;
  double x_rate_ = 0;
  double y_rate_ = 0;
  double damping_ = 0.5;
  double frequency_ = 10;
};

}  // namespace

STRIDE_UNIT(Linear)
