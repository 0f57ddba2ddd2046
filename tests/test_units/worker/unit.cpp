// Computes for a while in each step: for benchmarks.
#include <cstdint>

#include <stride/unit.h>

namespace {

class Worker : public stride::Unit {
 public:
  Worker() {
    describe("Follows its input, and computes before it does");
    input("u", u_);
    output("y", y_).exact().depends_on({});
    parameter("rounds", rounds_).description("of the computation; each takes some nanoseconds");
    state();
  }

  void step(stride::Step&) override {
    double value = u_;
    for (std::int32_t i = 0; i < rounds_; ++i) value = 0.5 * (value + u_ / (value + 1));
    y_ = value;
  }

 private:
  double u_ = 1;
  double y_ = 1;
  std::int32_t rounds_ = 0;
};

}  // namespace

STRIDE_UNIT(Worker)
