#include "master/front/cli/program/hard_limits.h"

#include <algorithm>
#include <atomic>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace stride::cli {
namespace {

std::atomic<pid_t> keeper{0};

long system_call(pid_t process, int resource, const rlimit* wanted, rlimit* before) {
  return ::syscall(SYS_prlimit64, process, resource, wanted, before);
}

/// `wanted`, with the present hard limit at least. What the kernel refuses stays as it is.
rlimit allowed(const rlimit& wanted, int resource) {
  rlimit present{};
  const bool is_valid = wanted.rlim_cur <= wanted.rlim_max;
  if (!is_valid || system_call(0, resource, nullptr, &present) != 0) return wanted;
  return {wanted.rlim_cur, std::max(wanted.rlim_max, present.rlim_max)};
}

/// Returns what prlimit() does.
int limit(pid_t process, int resource, const rlimit* wanted, rlimit* before) {
  const pid_t self = ::getpid();
  const bool is_kept = wanted != nullptr && self == keeper && (process == 0 || process == self);
  if (!is_kept) return static_cast<int>(system_call(process, resource, wanted, before));
  const rlimit kept = allowed(*wanted, resource);
  return static_cast<int>(system_call(process, resource, &kept, before));
}

static_assert(sizeof(rlimit) == sizeof(rlimit64));

}  // namespace

void keep_hard_limits() { keeper = ::getpid(); }

}  // namespace stride::cli

// Exported, so that a unit which calls them reaches these.
extern "C" int prlimit(pid_t process, enum __rlimit_resource resource, const rlimit* wanted,
                       rlimit* before) noexcept {
  return stride::cli::limit(process, resource, wanted, before);
}
extern "C" int prlimit64(pid_t process, enum __rlimit_resource resource, const rlimit64* wanted,
                         rlimit64* before) noexcept {
  return stride::cli::limit(process, resource, reinterpret_cast<const rlimit*>(wanted),
                            reinterpret_cast<rlimit*>(before));
}
extern "C" int setrlimit(__rlimit_resource_t resource, const rlimit* wanted) noexcept {
  return stride::cli::limit(0, resource, wanted, nullptr);
}
extern "C" int setrlimit64(__rlimit_resource_t resource, const rlimit64* wanted) noexcept {
  return stride::cli::limit(0, resource, reinterpret_cast<const rlimit*>(wanted), nullptr);
}
