#include "master/loader/fmu/fmi2/asynchronous_step.h"

namespace stride::importer {

void AsynchronousStep::begin() {
  const std::lock_guard lock(mutex_);
  status_.reset();
}

void AsynchronousStep::note_polled() {
  const std::lock_guard lock(mutex_);
  late_ += !status_;
}

void AsynchronousStep::finish(Status status) noexcept {
  const std::lock_guard lock(mutex_);
  if (status == Status::Pending) return;
  if (late_ > 0) {
    --late_;
    return;
  }
  status_ = status;
  is_finished_.notify_one();
}

std::optional<Status> AsynchronousStep::wait(std::chrono::microseconds time) {
  std::unique_lock lock(mutex_);
  is_finished_.wait_for(lock, time, [&] { return status_.has_value(); });
  return status_;
}

}  // namespace stride::importer
