// Does at chosen instants what a step may do. An instant before the start means never.
#include <optional>
#include <string>

#include <stride/unit.h>

namespace {

class Stepper : public stride::Unit {
 public:
  Stepper() {
    auto& info = describe("Rejects, returns early, wants events, ends the run");
    info.early_return = true;
    info.may_reject = true;
    parameter("largest_step", largest_step_).unit("s").description("a larger one is rejected");
    parameter("early_at", early_at_).unit("s").description("steps across it return there");
    parameter("event_at", event_at_).unit("s").description("announced once as its next event");
    parameter("withdraw_at", withdraw_at_).unit("s").description("an event there withdraws it");
    parameter("tick_at", tick_at_).unit("s").description("a step that ends there ticks the clock");
    parameter("end_at", end_at_).unit("s").description("a step that ends there ends the run");
    parameter("logs", logs_).description("each step logs its number, and a warning");
    output("steps", steps_).exact().depends_on({});
    output("events", events_).exact().depends_on({});
    output("clock", clock_);
    output("count", count_).clocked_by(clock_).exact();
    output("position", position_).unit("m").exact().depends_on({}).derivative(speed_);
    state(speed_);
  }

  void step(stride::Step& step) override {
    if (step.size() > stride::duration_from_seconds(largest_step_)) {
      return step.reject("a step may be " + std::to_string(largest_step_) + " s long at most");
    }
    stride::Time to = step.to();
    if (const auto early = instant(early_at_);
        early && step.early_return_allowed() && step.from() < *early && *early < to) {
      to = *early;
      step.return_early(to);
      step.need_event();
    }
    position_ += speed_ * stride::to_seconds(to - step.from());
    ++steps_;
    if (logs_) {
      log(stride::Severity::Info, "step " + std::to_string(steps_));
      log(stride::Severity::Warning, "steps are tiring");
    }
    if (instant(tick_at_) == to) {
      ++count_;
      clock_.tick();
    }
    if (instant(end_at_) == to) step.terminate_simulation();
  }

  void event(stride::Event& event) override {
    const auto next = instant(event_at_);
    if (events_ == 0 && next && event.time() < *next) event.next_event(*next);
    if (instant(withdraw_at_) == event.time()) event.no_next_event();
    ++events_;
    if (next == event.time() && !iterated_) {
      iterated_ = true;
      event.iterate();
    }
  }

  void save_state(stride::StateWriter& writer) const override { writer.write(iterated_); }
  void load_state(stride::StateReader& reader) override { reader.read(iterated_); }

 private:
  static std::optional<stride::Time> instant(double seconds) {
    if (seconds < 0) return std::nullopt;
    return stride::time_from_seconds(seconds);
  }

  double largest_step_ = 1e6;
  double early_at_ = -1;
  double event_at_ = -1;
  double withdraw_at_ = -1;
  double tick_at_ = -1;
  double end_at_ = -1;
  bool logs_ = false;
  std::int32_t steps_ = 0;
  std::int32_t events_ = 0;
  stride::Clock clock_;
  std::uint32_t count_ = 0;
  double position_ = 0;
  double speed_ = 2;
  bool iterated_ = false;
};

}  // namespace

STRIDE_UNIT(Stepper)
