// Its output is NaN from an instant on.
#include <limits>

#include <stride/unit.h>

namespace {

class NotANumber : public stride::Unit {
 public:
  NotANumber() {
    parameter("nan_at", nan_at_).unit("s").description("instant from which y is NaN");
    output("y", y_).exact().depends_on({});
    state();
  }

  void step(stride::Step& step) override {
    const bool is_time = stride::to_seconds(step.to()) >= nan_at_;
    y_ = is_time ? std::numeric_limits<double>::quiet_NaN() : stride::to_seconds(step.to());
  }

 private:
  double nan_at_ = 0;
  double y_ = 0;
};

}  // namespace

STRIDE_UNIT(NotANumber)
