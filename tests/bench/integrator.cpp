// y' = u, behind a pipe.
#include <stride/process/program.h>

namespace {

class Integrator : public stride::process::Program {
 public:
  Integrator() {
    input("u", u_);
    output("y", y_);
  }

 private:
  stride::Time step(stride::Time to, bool /*may_stop*/) override {
    y_ += u_ * stride::to_seconds(to - now());
    return to;
  }

  double u_ = 0;
  double y_ = 0;
};

}  // namespace

int main() { return Integrator().run(); }
