// A Boolean that follows its input at once, upside down if wanted.
#include <stride/unit.h>

namespace {

class Inverter : public stride::Unit {
 public:
  Inverter() {
    describe("y = u, or its opposite, at each instant");
    input("u", u_);
    output("y", y_).depends_on({"u"});
    parameter("inverts", inverts_);
    state();
  }

  void step(stride::Step&) override { update_outputs(); }
  void update_outputs() override { y_ = u_ != inverts_; }

 private:
  bool u_ = false;
  bool y_ = false;
  bool inverts_ = true;
};

}  // namespace

STRIDE_UNIT(Inverter)
