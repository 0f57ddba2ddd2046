// Does in a step what it has not declared that it may do. A duration of zero means never.
#include <stride/unit.h>

namespace {

class Liar : public stride::Unit {
 public:
  Liar() {
    describe("Rejects or returns early without having declared it");
    parameter("rejects", rejects_).description("it rejects each step");
    parameter("early_after", early_after_)
        .unit("s")
        .min(0)
        .description("it returns that long after the start of a step");
    output("steps", steps_).exact().depends_on({});
    state();
  }

  void step(stride::Step& step) override {
    if (rejects_) return step.reject("out of spite");
    ++steps_;
    const auto early = stride::duration_from_seconds(early_after_);
    if (early > early.zero()) step.return_early(step.from() + early);
  }

 private:
  bool rejects_ = false;
  double early_after_ = 0;
  std::int32_t steps_ = 0;
};

}  // namespace

STRIDE_UNIT(Liar)
