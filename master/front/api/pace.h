// Tells a caller now and then how far a run has come.
#ifndef STRIDE_MASTER_FRONT_API_PACE_H
#define STRIDE_MASTER_FRONT_API_PACE_H

#include <chrono>
#include <functional>
#include <utility>

#include "master/base/sparse_clock.h"
#include "master/engine/port/observer.h"

namespace stride::api {

class Pace final : public core::Observer {
 public:
  using Tell = std::function<void(Time)>;

  static constexpr std::chrono::milliseconds kInterval{100};

  explicit Pace(Tell tell) : tell_(std::move(tell)) {}

  void on_communication_point(Time time) override {
    if (!clock_.read() || clock_.now() - told_ < kInterval) return;
    told_ = clock_.now();
    tell_(time);
  }

 private:
  Tell tell_;
  core::SparseClock clock_;
  core::SparseClock::Clock::time_point told_ = clock_.now();
};

}  // namespace stride::api

#endif
