#include "master/loader/process/memory_watch.h"

#include <algorithm>

#include <unistd.h>

#include "master/base/child_process/children.h"
#include "master/base/child_process/process_memory.h"

namespace stride::isolation {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kLeastPause{10};
/// A measurement may take this share of the time.
constexpr int kShare = 100;
/// The limit of a process, which a unit can handle, comes first.
constexpr std::uint64_t kTolerance = std::uint64_t{4} << 20;

}  // namespace

MemoryWatch::MemoryWatch(const MemoryAllowance& allowance) : limit_(allowance.limit) {
  if (!limit_) return;
  use_.emplace(allowance.folders);
  before_ = data_memory(::getpid()) + use_->bound({});
}

int MemoryWatch::pause() const {
  if (!limit_) return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_ - Clock::now());
  return static_cast<int>(std::max(left, 0ms).count());
}

std::optional<std::uint64_t> MemoryWatch::excess() {
  const auto began = Clock::now();
  if (!limit_ || began < next_) return std::nullopt;
  const std::optional<std::uint64_t> taken = measure();
  const auto end = Clock::now();
  next_ = end + std::max<Clock::duration>(kLeastPause, kShare * (end - began));
  return taken;
}

std::optional<std::uint64_t> MemoryWatch::measure() const {
  std::vector<pid_t> processes;
  for (const pid_t process : descendants_of(::getpid())) {
    if (const auto thread = living_thread(process)) processes.push_back(*thread);
  }
  const std::uint64_t most = before_ + *limit_ + kTolerance;
  if (use_->bound(processes) <= most) return std::nullopt;
  const std::uint64_t bytes = use_->of(processes);
  if (bytes <= most) return std::nullopt;
  return bytes - before_;
}

}  // namespace stride::isolation
