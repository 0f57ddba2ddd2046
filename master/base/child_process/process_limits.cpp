#include "master/base/child_process/process_limits.h"

#include <algorithm>
#include <iterator>

namespace stride::isolation {

ProcessLimits::ProcessLimits(pid_t process) noexcept {
  for (int resource = 0; resource < RLIM_NLIMITS; ++resource) {
    ::prlimit(process, static_cast<__rlimit_resource>(resource), nullptr, &limits_[resource]);
  }
}

bool ProcessLimits::operator==(const ProcessLimits& other) const noexcept {
  return std::equal(std::begin(limits_), std::end(limits_), std::begin(other.limits_),
                    [](const rlimit& one, const rlimit& two) {
                      return one.rlim_cur == two.rlim_cur && one.rlim_max == two.rlim_max;
                    });
}

}  // namespace stride::isolation
