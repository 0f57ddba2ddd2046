// A program, not a unit.
#include <stride/process/program.h>

namespace {

class Pump : public stride::process::Program {
 public:
  Pump() {
    input("rate", rate_);
    output("sum", sum_);
  }

 private:
  stride::Time step(stride::Time to, bool /*may_stop*/) override {
    sum_ += rate_ * stride::to_seconds(to - now());
    return to;
  }

  double rate_ = 0;
  double sum_ = 0;
};

}  // namespace

int main() { return Pump().run(); }
