// Gives a verdict: whether its input has stayed below a limit.
#include <algorithm>
#include <string>

#include <stride/unit.h>

namespace {

class Judge : public stride::Unit {
 public:
  Judge() {
    describe("Judges whether its input stays below a limit");
    input("u", u_);
    output("below", below_).depends_on({}).verdict();
    output("why", why_).depends_on({}).verdict_text();
    output("highest", highest_).depends_on({});
    parameter("limit", limit_);
    state();
  }

  void initialize(stride::Time) override { judge(0); }
  void step(stride::Step&) override { judge(std::max(highest_, u_)); }

 private:
  void judge(double highest) {
    highest_ = highest;
    below_ = highest < limit_;
    why_ = below_ ? "the limit was not reached" : "the limit was reached";
  }

  double u_ = 0, highest_ = 0, limit_ = 1;
  bool below_ = true;
  std::string why_;
};

}  // namespace

STRIDE_UNIT(Judge)
