#include "master/front/cli/run/live/real_time.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/number_text.h"
#include "master/base/time_text.h"

namespace stride::cli {
namespace {

using namespace std::chrono_literals;

/// A signal that comes just before a pause does not shorten it.
constexpr auto kLongestPause = 20ms;
constexpr auto kMeanwhile = 1s;
constexpr std::chrono::duration<double> kNoticed = 100ms;

std::string milliseconds(std::chrono::duration<double> time) {
  return fmt::format("{:.1f} ms", time.count() * 1e3);
}

}  // namespace

double parse_real_time_factor(const std::string& text) {
  try {
    const double factor = core::parse_at_least_zero(text);
    if (factor > 0) return factor;
  } catch (const std::invalid_argument&) {  // told below
  }
  core::fail_input(
      {},
      fmt::format("--realtime {}: expected how many seconds are simulated in one of the "
                  "wall clock, a number above 0",
                  text),
      "--realtime 0.5 is half as fast as real time");
}

WallClock::WallClock()
    : wait_until([](Instant instant) { std::this_thread::sleep_until(instant); }) {}

RealTime::RealTime(double factor, const volatile std::sig_atomic_t& interrupted, WallClock clock)
    : factor_(factor), interrupted_(interrupted), clock_(std::move(clock)) {}

void RealTime::on_communication_point(Time time) {
  WallClock::Instant now = clock_.now();
  if (!origin_) origin_ = {time, now};
  const Seconds after = Seconds(to_seconds(time - origin_->time)) / factor_;
  // a year-long pause is as good as one without an end
  constexpr Seconds kLongest = std::chrono::hours(24 * 365);
  const WallClock::Instant due =
      origin_->wall +
      std::chrono::duration_cast<WallClock::Instant::duration>(std::min(after, kLongest));
  lag_ = now - due;
  if (lag_ > greatest_lag_) {
    greatest_lag_ = lag_;
    latest_ = time;
  }
  if (now < due && meanwhile_ && now - meanwhile_done_ >= kMeanwhile) {
    meanwhile_();
    meanwhile_done_ = now;
  }
  for (; now < due && interrupted_ == 0; now = clock_.now()) {
    clock_.wait_until(std::min(due, now + kLongestPause));
  }
}

std::string RealTime::text() const {
  if (!origin_) return "";
  const std::string pace = factor_ == 1 ? "Real time" : fmt::format("{} x real time", factor_);
  if (greatest_lag_ <= Seconds::zero()) return pace + ": never late";
  return fmt::format("{}: {} late at most, at {} s; {} at the end", pace,
                     milliseconds(greatest_lag_), core::to_text(latest_),
                     milliseconds(std::max(lag_, Seconds::zero())));
}

bool RealTime::is_late() const { return lag_ > kNoticed; }

}  // namespace stride::cli
