#include <algorithm>
#include <stdexcept>
#include <string>

#include <stride/systemc/time.h>
#include <stride/systemc/timer.h>

namespace stride::systemc {
namespace {

Kernel& surrounding_kernel(const char* timer) {
  if (Kernel::current() != nullptr) return *Kernel::current();
  throw std::logic_error(std::string("the timer ") + timer +
                         " is not constructed within a device's kernel");
}

}  // namespace

Timer::Timer(const char* name) : kernel_(surrounding_kernel(name)), event_(name) {
  kernel_.timers_.push_back(this);
}

Timer::~Timer() {
  auto& timers = kernel_.timers_;
  timers.erase(std::find(timers.begin(), timers.end(), this));
}

void Timer::set(Time at) {
  const Time now = kernel_.now();
  if (at < now) {
    throw std::invalid_argument(std::string("the timer ") + event_.name() + " is set to " +
                                decimal_seconds(now - at) + " s ago");
  }
  cancel();
  if (at == now) return event_.notify(sc_core::SC_ZERO_TIME);
  due_ = at;
  kernel_.set_alarm();
}

void Timer::set_after(Duration delay) { set(later(kernel_.now(), delay)); }

void Timer::cancel() {
  due_.reset();
  event_.cancel();
}

void Timer::go_off() {
  due_.reset();
  event_.notify();
}

}  // namespace stride::systemc
