// Rejects each step that is longer than a limit, which is drawn anew after each step that it makes.
// A step that it accepts it also accepts in a shorter form, and a restored state draws the same
// limit again.
#include <cstdint>
#include <stdexcept>
#include <string>

#include <stride/unit.h>

#include "tests/test_units/counted_random.h"

namespace {

class Rejecter : public stride::Unit {
 public:
  Rejecter() {
    describe("Rejects steps longer than a random limit; y' = u").may_reject = true;
    input("u", u_);
    output("y", y_).exact().depends_on({}).derivative(u_);
    output("steps", steps_).exact().depends_on({}).description("made so far");
    parameter("seed", seed_);
    parameter("shortest", shortest_).unit("s").min(1e-9).description("lower bound of the limit");
    parameter("longest", longest_).unit("s").min(1e-9).description("upper bound of the limit");
#ifndef WITHOUT_STATE
    state();
#endif
  }

  void initialize(stride::Time) override {
    if (longest_ < shortest_) throw std::invalid_argument("'longest' must not be below 'shortest'");
  }

  void step(stride::Step& step) override {
    const double limit =
        shortest_ + (longest_ - shortest_) * stride::tests::random_uniform(seed_, steps_);
    const double size = stride::to_seconds(step.size());
    if (size > limit) return step.reject("the limit is " + std::to_string(limit) + " s now");
    y_ += u_ * size;
    ++steps_;
  }

 private:
  double u_ = 0;
  double y_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t seed_ = 1;
  double shortest_ = 1;
  double longest_ = 1;
};

}  // namespace

STRIDE_UNIT(Rejecter)
