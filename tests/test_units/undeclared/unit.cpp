// Says nothing of what its outputs depend on; one of them depends on no input.
#include <cstdint>

#include <stride/unit.h>

namespace {

class Undeclared : public stride::Unit {
 public:
  Undeclared() {
    describe("A constant, and a gain, without a word on their dependencies");
    input("u", u_);
    output("constant", constant_);
    output("doubled", doubled_);
    output("initializations", initializations_)
        .depends_on({})
        .description("calls before the start");
    parameter("value", value_);
    state();
  }

  void initialize(stride::Time) override {
    ++initializations_;
    constant_ = value_;
  }
  void step(stride::Step&) override { update_outputs(); }
  void update_outputs() override { doubled_ = 2 * u_; }

 private:
  double u_ = 0;
  double constant_ = 0;
  double doubled_ = 0;
  double value_ = 5;
  std::int32_t initializations_ = 0;
};

}  // namespace

STRIDE_UNIT(Undeclared)
