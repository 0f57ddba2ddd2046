// Stops at known instants, whatever the communication steps are.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <stride/unit.h>

namespace {

class Early : public stride::Unit {
 public:
  Early() {
    describe("Stops early at known instants; y' = u").early_return = true;
    input("u", u_);
    output("y", y_).exact().depends_on({}).derivative(u_);
    output("stops", stops_).exact().depends_on({}).description("instants that have been passed");
    output("events", events_).exact().depends_on({}).description("handled at such an instant");
    parameter("instants", instants_).unit("s").description("in any order; negative: none");
    parameter("wants_events", wants_events_).description("Event Mode is wanted at each instant");
#ifndef WITHOUT_STATE
    state(awaits_event_);
#endif
  }

  // Without the permission to return early it passes the instants, and has its event at the end.
  void step(stride::Step& step) override {
    stride::Time to = step.to();
    for (auto next = first_after(step.from()); next && *next <= to; next = first_after(*next)) {
      ++stops_;
      awaits_event_ = wants_events_;
      if (step.early_return_allowed()) to = *next;
    }
    if (awaits_event_) step.need_event();
    if (to < step.to()) step.return_early(to);
    y_ += u_ * stride::to_seconds(to - step.from());
  }

  void event(stride::Event&) override {
    if (awaits_event_) ++events_;
    awaits_event_ = false;
  }

 private:
  std::optional<stride::Time> first_after(stride::Time time) const {
    std::optional<stride::Time> first;
    for (const double seconds : instants_) {
      if (seconds < 0) continue;
      const stride::Time instant = stride::time_from_seconds(seconds);
      if (instant > time && (!first || instant < *first)) first = instant;
    }
    return first;
  }

  double u_ = 0;
  double y_ = 0;
  std::int32_t stops_ = 0;
  std::int32_t events_ = 0;
  std::array<double, 8> instants_{-1, -1, -1, -1, -1, -1, -1, -1};
  bool wants_events_ = true;
  bool awaits_event_ = false;  ///< since it has passed an instant
};

}  // namespace

STRIDE_UNIT(Early)
