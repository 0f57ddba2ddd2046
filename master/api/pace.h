// Tells a caller now and then how far a run has come.
#ifndef STRIDE_MASTER_API_PACE_H
#define STRIDE_MASTER_API_PACE_H

#include <chrono>
#include <cstdint>
#include <functional>

#include "master/algorithm/observer.h"

namespace stride::api {

/// Reads the clock at some of the communication points only, so many that a call is late by little.
class Pace final : public core::Observer {
 public:
  using Clock = std::chrono::steady_clock;
  using Tell = std::function<void(Time)>;

  static constexpr std::chrono::milliseconds kInterval{100};

  explicit Pace(Tell tell) : tell_(std::move(tell)) {}

  void on_communication_point(Time time) override {
    if (--until_reading_ == 0) read_clock(time);
  }

 private:
  static constexpr std::uint32_t kMostBetween = 4096;

  void read_clock(Time time) {
    const Clock::time_point now = Clock::now();
    if (now - read_ > kInterval / 10) {
      between_ = 1;
    } else if (now - read_ < kInterval / 100 && between_ < kMostBetween) {
      between_ *= 2;
    }
    read_ = now;
    until_reading_ = between_;
    if (now - told_ < kInterval) return;
    told_ = now;
    tell_(time);
  }

  Tell tell_;
  Clock::time_point read_ = Clock::now(), told_ = read_;
  std::uint32_t between_ = 1, until_reading_ = 1;
};

}  // namespace stride::api

#endif
