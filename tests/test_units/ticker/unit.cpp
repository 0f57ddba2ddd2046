// Ticks at start + k sqrt(2) period, k = 1, 2, …, rounded to picoseconds: instants that lie on no
// grid. It announces them (fmi3UpdateDiscreteStates, nextEventTime), or finds them within the step
// and returns early; the messages are the same.
#include <cstdint>

#include <stride/unit.h>

namespace {

constexpr double kSqrt2 = 1.4142135623730951;

class Ticker : public stride::Unit {
 public:
  Ticker() {
    describe("Ticks at irrational times").early_return = true;
    output("tick.clock", clock_);
    output("tick.number", number_).clocked_by(clock_).description("k");
    output("tick.picoseconds", picoseconds_).clocked_by(clock_).description("when it is due");
    output("level", level_).discrete().depends_on({}).description("1 after each odd tick, else 0");
    parameter("period", period_).unit("s").min(1e-9);
    parameter("announces", announces_).description("its ticks before they come");
    state(start_, next_, ticks_);
  }

  void initialize(stride::Time start) override {
    start_ = start;
    level_ = 0;
    ticks_ = 0;
    aim();
  }

  void step(stride::Step& step) override {
    if (announces_ || next_ > step.to()) return;
    step.need_event();
    if (step.early_return_allowed() && next_ > step.from()) step.return_early(next_);
  }

  // Where the importer came too late, each tick has an event iteration of its own.
  void event(stride::Event& event) override {
    if (next_ <= event.time()) {
      number_ = ++ticks_;
      picoseconds_ = next_.time_since_epoch().count();
      level_ = static_cast<double>(ticks_ % 2);
      clock_.tick();
      aim();
    }
    if (announces_) event.next_event(next_);
  }

 private:
  void aim() {
    const double offset = static_cast<double>(ticks_ + 1) * kSqrt2 * period_;
    next_ = start_ + stride::duration_from_seconds(offset);
  }

  stride::Clock clock_;
  std::int64_t number_ = 0;
  std::int64_t picoseconds_ = 0;
  double level_ = 0;
  double period_ = 1e-3;
  bool announces_ = true;
  stride::Time start_{};
  stride::Time next_{};
  std::int64_t ticks_ = 0;
};

}  // namespace

STRIDE_UNIT(Ticker)
