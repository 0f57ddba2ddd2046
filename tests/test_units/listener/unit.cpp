// Receives the messages of a ticker or a bouncing ball, and notices one that comes at another
// instant than it was sent for, out of turn, or twice.
#include <cstdint>

#include <stride/unit.h>

namespace {

class Listener : public stride::Unit {
 public:
  Listener() {
    describe("Receives numbered messages, each of which carries its own time");
    input("message.clock", clock_);
    input("message.number", number_).clocked_by(clock_);
    input("message.picoseconds", picoseconds_).clocked_by(clock_);
    output("received", received_).exact().depends_on({});
    output("misplaced", misplaced_).exact().depends_on({}).description("came at another instant");
    output("out_of_turn", out_of_turn_).exact().depends_on({}).description("not the next number");
    state();
  }

  void step(stride::Step&) override {}

  void event(stride::Event& event) override {
    if (!clock_.ticked()) return;
    ++received_;
    if (picoseconds_ != event.time().time_since_epoch().count()) ++misplaced_;
    if (number_ != received_) ++out_of_turn_;
  }

 private:
  stride::Clock clock_;
  std::int64_t number_ = 0;
  std::int64_t picoseconds_ = 0;
  std::int64_t received_ = 0;
  std::int64_t misplaced_ = 0;
  std::int64_t out_of_turn_ = 0;
};

}  // namespace

STRIDE_UNIT(Listener)
