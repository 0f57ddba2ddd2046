#include "master/base/process/deadline.h"

#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

namespace stride::core {

struct Deadline::Timer {
  timer_t id;
};

Deadline::Deadline(std::optional<std::chrono::milliseconds> limit) {
  if (!limit) return;
  sigevent kill{};
  kill.sigev_notify = SIGEV_SIGNAL;
  kill.sigev_signo = SIGKILL;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(*limit);
  const std::chrono::nanoseconds rest = *limit - seconds;
  const itimerspec once{{},
                        {static_cast<time_t>(seconds.count()), static_cast<long>(rest.count())}};
  auto timer = std::make_unique<Timer>();
  if (::timer_create(CLOCK_MONOTONIC, &kill, &timer->id) != 0) {
    throw std::system_error(errno, std::generic_category(), "timer_create");
  }
  timer_ = std::move(timer);
  ::timer_settime(timer_->id, 0, &once, nullptr);
}

Deadline::~Deadline() {
  if (timer_) ::timer_delete(timer_->id);
}

}  // namespace stride::core
