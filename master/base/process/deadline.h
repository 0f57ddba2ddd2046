// A process that must not go on for too long.
#ifndef STRIDE_MASTER_BASE_PROCESS_DEADLINE_H
#define STRIDE_MASTER_BASE_PROCESS_DEADLINE_H

#include <chrono>
#include <memory>
#include <optional>

namespace stride::core {

/// The kernel kills this process by SIGKILL when the time is over, unless the object is gone by
/// then. Forks of the process have none.
class Deadline {
 public:
  /// Nothing: none. Throws std::system_error.
  explicit Deadline(std::optional<std::chrono::milliseconds> limit);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

 private:
  struct Timer;
  std::unique_ptr<Timer> timer_;
};

}  // namespace stride::core

#endif
