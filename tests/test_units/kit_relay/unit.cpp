// What relay computes, made with the unit kit.
#include <stride/unit.h>

namespace {

class KitRelay : public stride::Unit {
 public:
  KitRelay() {
    input("u", u_);
    output("y", y_);
    state(y_);
  }

  void step(stride::Step& step) override { y_ += stride::to_seconds(step.size()) * (u_ - y_); }

 private:
  double u_ = 0;
  double y_ = 0;
};

}  // namespace

STRIDE_UNIT(KitRelay)
