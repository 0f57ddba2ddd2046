// The limits of resources that a process has (setrlimit).
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_PROCESS_LIMITS_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_PROCESS_LIMITS_H

#include <sys/resource.h>
#include <sys/types.h>

namespace stride::isolation {

/// As they were when this object was made: any process of this user may change them (prlimit).
class ProcessLimits {
 public:
  /// 0: those of this process. All are 0 if there is no such process.
  explicit ProcessLimits(pid_t process = 0) noexcept;
  bool operator==(const ProcessLimits& other) const noexcept;

 private:
  rlimit limits_[RLIM_NLIMITS]{};
};

}  // namespace stride::isolation

#endif
