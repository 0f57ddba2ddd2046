// Allows one instance per process only.
#include <stride/unit.h>

namespace {

class Single : public stride::Unit {
 public:
  Single() {
    describe("One per process").single_instance = true;
    output("steps", steps_).exact().depends_on({});
    state();
  }
  void step(stride::Step&) override { ++steps_; }

 private:
  std::int32_t steps_ = 0;
};

}  // namespace

STRIDE_UNIT(Single)
