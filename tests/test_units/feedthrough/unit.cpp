// An output that follows its input at once: y = f(u), an element of algebraic loops.
#include <cmath>
#include <cstdint>

#include <stride/unit.h>

namespace {

class Feedthrough : public stride::Unit {
 public:
  Feedthrough() {
    describe("y = slope * u + offset, or cos(slope * u) + offset, at each instant");
    input("u", u_);
    output("y", y_).depends_on({"u"});
    output("events", events_).exact().depends_on({});
    parameter("cosine", cosine_);
    parameter("slope", slope_);
    parameter("offset", offset_);
    parameter("jump_at", jump_at_).unit("s").description("before the start: never");
    parameter("jump_to", jump_to_).description("offset from then on");
    state(now_);
  }

  void initialize(stride::Time) override { now_ = offset_; }

  void step(stride::Step&) override { update_outputs(); }

  void event(stride::Event& event) override {
    ++events_;
    if (jump_at_ < 0) return;
    const stride::Time jump = stride::time_from_seconds(jump_at_);
    if (event.time() >= jump) {
      now_ = jump_to_;
    } else {
      event.next_event(jump);
    }
  }

  void update_outputs() override { y_ = (cosine_ ? std::cos(slope_ * u_) : slope_ * u_) + now_; }

 private:
  bool cosine_ = false;
  double u_ = 0;
  double y_ = 0;
  double slope_ = 1;
  double offset_ = 0;
  double jump_at_ = -1;
  double jump_to_ = 0;
  double now_ = 0;  // the offset
  std::int32_t events_ = 0;
};

}  // namespace

STRIDE_UNIT(Feedthrough)
