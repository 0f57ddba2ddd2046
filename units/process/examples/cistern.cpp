// The cistern of resources/cistern.py once more, in C++.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include <stride/process/program.h>

namespace {

using stride::Duration;
using stride::Time;

class Cistern : public stride::process::Program {
 public:
  Cistern() {
    parameter("capacity", capacity_);
    parameter("report_period", report_period_);
    input("inflow", inflow_);
    output("volume", volume_);
    output("alarms", alarms_);
    message_input<std::string>("order.text", [this](const std::string& order) { receive(order); });
  }

 private:
  void start() override {
    period_ = stride::duration_from_seconds(report_period_);
    next_report_ = now() + period_;
  }

  /// From one happening to the next, until `to`, or until the first if it may stop there.
  Time step(Time to, bool may_stop) override {
    for (Time time = now();;) {
      const Time full_at = when_full(time);
      const Time at = std::min({to, full_at, next_report_});
      volume_ = at == full_at ? capacity_ : volume_after(at - time);
      time = at;
      if (at == full_at) {
        ++alarms_;
        send("alarm.text", at, "full with " + text(capacity_) + " m3");
      }
      const bool is_reported = at == next_report_;
      if (is_reported) {
        next_report_ += period_;
        send("report.text", at, text(volume_) + " m3");
      }
      if (at == to || (may_stop && (at == full_at || is_reported))) return at;
    }
  }

  std::optional<Time> next_event() override { return next_report_; }

  Time when_full(Time time) const {
    if (volume_ >= capacity_ || inflow_ <= 0) return Time::max();
    const double picoseconds = std::ceil((capacity_ - volume_) / inflow_ * 1e12);
    return picoseconds < stride::kMaxSeconds * 1e12
               ? stride::later(time, Duration(static_cast<stride::Picoseconds>(picoseconds)))
               : Time::max();
  }

  double volume_after(Duration passed) const {
    const double volume = volume_ + inflow_ * stride::to_seconds(passed);
    return std::min(std::max(volume, 0.0), std::max(capacity_, volume_));
  }

  void receive(const std::string& order) {
    if (order == "empty") {
      volume_ = 0;
    } else {
      log(stride::process::LogLevel::Warning, "what is '" + order + "'? Expected 'empty'");
    }
  }

  /// As Python has it.
  static std::string text(double number) {
    std::string text;
    stride::process::append_value(text, number);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }

  double capacity_ = 1;
  double report_period_ = 0.5;
  double inflow_ = 0;
  double volume_ = 0;
  std::uint32_t alarms_ = 0;
  Duration period_{};
  Time next_report_{};
};

}  // namespace

int main() { return Cistern().run(); }
