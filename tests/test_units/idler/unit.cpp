// A leaky tank, level' = rate (inflow - level), in closed form, which reports each `period` with a
// tick. Between reports it promises to be idle: honestly, or not, in each of the ways in which a
// promise can be broken.
#include <algorithm>
#include <cmath>

#include <stride/unit.h>

namespace {

constexpr double kDeadband = 1e-5;

enum class Promise : std::int64_t {
  Honest,
  Ticks,
  ReturnsEarly,
  Rejects,
  LeavesItsTangent,
  LosesTime,  ///< a step that skips has its next report come late
  Ever,       ///< without an end, whatever comes
  Forgets,    ///< a long step that skips does not count for its age
};

class Idler : public stride::Unit {
 public:
  Idler() {
    stride::UnitInfo& info = describe("A tank that promises to be idle");
    info.promises_idle = info.early_return = info.may_reject = true;
#ifdef WITH_SHORT_STEPS
    info.maximum_step = std::chrono::milliseconds(500);
#endif
    input("inflow", inflow_).deadband(kDeadband);
    input("ask", ask_).description("a report is wanted");
    input("mark", mark_).description("has no effect");
    output("level", level_).derivative(slope_).tolerance(1e-3).depends_on({});
    output("reports", reports_).depends_on({}).description("how many there were");
    output("report", report_);
    local("steps", steps_);
    parameter("rate", rate_).unit("1/s").min(0);
    parameter("period", period_).unit("s").description("0: reports only when it is asked").min(0);
    parameter("announces", announces_).description("its reports, so that no step passes them");
    parameter("promise", promise_)
        .items({{"honest", 0},
                {"ticks", 1},
                {"returns_early", 2},
                {"rejects", 3},
                {"drifts", 4},
                {"loses_time", 5},
                {"ever", 6},
                {"forgets", 7}});
    output("age", shown_age_)
        .unit("s")
        .discrete()
        .depends_on({})
        .description("when it was asked last, as it has counted since the start");
    state(start_, slope_, time_, age_);
  }

  void initialize(stride::Time start) override {
    start_ = time_ = start;
    level_ = 0;
    reports_ = 0;
    steps_ = 0;
    age_ = {};
    shown_age_ = 0;
    slope_ = rate_ * (inflow_ - level_);
  }

  void step(stride::Step& step) override {
    if (promise_ == Promise::Rejects && step.size() > kLongest) {
      return step.reject("this is too long for me");
    }
    ++steps_;
    const bool skips = max_skip().has_value() && step.size() > kLongest;
    if (promise_ == Promise::LosesTime && skips) start_ += std::chrono::microseconds(300);
    stride::Time to = step.to();
    if (promise_ == Promise::ReturnsEarly && step.size() > kLongest) to = step.from() + kLongest;
    if (next_report() <= to && !announces_) {
      to = next_report();
      step.need_event();
    }
    if (promise_ == Promise::Ticks && step.size() > kLongest) {
      report_.tick();
      ++reports_;
    }
    if (to < step.to() && step.early_return_allowed()) step.return_early(to);
    advance(step.reached().value_or(step.to()));
  }

  void event(stride::Event& event) override {
    if (ask_.ticked()) shown_age_ = stride::to_seconds(age_);
    if (ask_.ticked() || next_report() <= event.time()) {
      ++reports_;
      report_.tick();
      start_ = event.time();
    }
    if (announces_ && period_ > 0) event.next_event(next_report());
  }

  stride::Time idle_until(stride::Time now) const override {
    if (promise_ == Promise::Ever) return stride::Time::max();
    if (slope_ != rate_ * (inflow_ - level_)) return now;  // the inflow is another since the step
    const double tolerance = tolerance_of(level_);
    const double curvature = rate_ * std::abs(slope_);
    if (promise_ == Promise::LeavesItsTangent) {
      return now + 10 * stride::tangent_holds_for(tolerance, curvature);
    }
    // the inflow may go anywhere within its deadband
    const auto holds = stride::tangent_holds_for(tolerance, curvature, rate_ * kDeadband);
    return std::min(stride::later(now, holds), next_report());
  }

 private:
  static constexpr stride::Duration kLongest = std::chrono::milliseconds(10);
  static constexpr stride::Duration kMemory = std::chrono::seconds(1);

  static stride::Duration seconds(double count) { return stride::duration_from_seconds(count); }

  stride::Time next_report() const {
    return period_ > 0 ? start_ + seconds(period_) : stride::Time::max();
  }

  void advance(stride::Time to) {
    const double elapsed = stride::to_seconds(to - time_);
    level_ = inflow_ + (level_ - inflow_) * std::exp(-rate_ * elapsed);
    slope_ = rate_ * (inflow_ - level_);
    const bool is_forgotten =
        promise_ == Promise::Forgets && max_skip().has_value() && to - time_ > kMemory;
    if (!is_forgotten) age_ += to - time_;
    time_ = to;
  }

  double inflow_ = 1;
  stride::Clock ask_;
  bool mark_ = false;
  double level_ = 0;
  double slope_ = 0;
  std::int64_t reports_ = 0;
  std::int64_t steps_ = 0;
  stride::Clock report_;
  double rate_ = 0.01;
  double period_ = 0;
  bool announces_ = false;
  Promise promise_ = Promise::Honest;
  stride::Time start_{};
  stride::Time time_{};
  stride::Duration age_{};
  double shown_age_ = 0;  // [s]
};

}  // namespace

STRIDE_UNIT(Idler)
