// A clock of each kind, with the number of its ticks and the instant of the last.
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include <stride/unit.h>

namespace {

using stride::Clock;
using stride::Duration;
using namespace std::chrono_literals;

struct Counter {
  Clock clock;
  std::int32_t ticks = 0;
  double last = -1;
};

class Clocks : public stride::Unit {
 public:
  Clocks() {
    describe("A clock of each kind");
    add("constant", constant_).every(3ms, 1ms);
    add("fixed", fixed_).every_fixed(5ms);
    add("fixed_by_unit", fixed_by_unit_).every_fixed();
    add("tunable", tunable_).every_tunable(7ms, 500us);
    add("tunable_by_unit", tunable_by_unit_).every_tunable();
    add("changing", changing_).changing();
    add("countdown", countdown_).countdown();
    add("triggered", triggered_);
    parameter("interval", interval_).unit("s").tunable().min(1e-12).description("by the unit");
    parameter("shift", shift_).unit("s").min(0).description("by the unit");
    parameter("echoes", echoes_)
        .min(0)
        .description("the changing clock ticks so often again at one instant");
    input("start", start_).description("its change counts 4 ms down");
    output("instants", instants_).exact().depends_on({}).description("events handled");
    local("late_ticks", late_ticks_).discrete().description("clocks that tick behind their event");
    state(echoed_, started_);
  }

  void initialize(stride::Time) override {
    fixed_by_unit_.clock.set_interval(interval());
    fixed_by_unit_.clock.set_shift(stride::duration_from_seconds(shift_));
    tunable_by_unit_.clock.set_interval(interval());
    tunable_by_unit_.clock.set_shift(stride::duration_from_seconds(shift_));
    changing_.clock.count_down(1ms);
    echoed_ = 0;
    started_ = start_;
  }

  void step(stride::Step&) override {}

  void update_outputs() override {
    if (std::exchange(has_handled_, false) && triggered_.clock.ticked()) ++late_ticks_;
  }

  void event(stride::Event& event) override {
    ++instants_;
    has_handled_ = true;
    tunable_by_unit_.clock.set_interval(interval());
    if (changing_.clock.ticked()) count_changing();
    for (Counter* counter : {&constant_, &fixed_, &fixed_by_unit_, &tunable_, &tunable_by_unit_,
                             &changing_, &countdown_, &triggered_}) {
      if (!counter->clock.ticked()) continue;
      ++counter->ticks;
      counter->last = stride::to_seconds(event.time());
    }
    if (start_ != started_) countdown_.clock.count_down(4ms);
    started_ = start_;
  }

 private:
  stride::VariableBuilder add(const std::string& name, Counter& counter) {
    output(name + ".ticks", counter.ticks).exact().depends_on({});
    output(name + ".last", counter.last).unit("s").discrete().exact().depends_on({});
    return input(name, counter.clock);
  }

  /// 1 ms, 2 ms, 3 ms, … after the tick before; 0 as often as is wanted.
  void count_changing() {
    if (echoed_ < echoes_) {
      ++echoed_;
      return changing_.clock.count_down(0ms);
    }
    echoed_ = 0;
    changing_.clock.count_down((changing_.ticks + 2) * 1ms);
  }

  Duration interval() const { return stride::duration_from_seconds(interval_); }

  Counter constant_, fixed_, fixed_by_unit_, tunable_, tunable_by_unit_, changing_, countdown_,
      triggered_;
  double interval_ = 0.002;
  double shift_ = 0.0005;
  std::int32_t echoes_ = 0;
  std::int32_t echoed_ = 0;
  bool start_ = false;
  bool started_ = false;
  std::int32_t instants_ = 0;
  bool has_handled_ = false;  ///< an event, since the last update of the outputs
  std::int32_t late_ticks_ = 0;
};

}  // namespace

STRIDE_UNIT(Clocks)
