#include "master/front/cli/program/memory_limits.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include "master/base/error.h"

namespace stride::cli {
namespace {

/// Reading XML with elements inside each other, and units without a host, need the most.
constexpr rlim_t kLeastStack = rlim_t{256} << 10;
constexpr rlim_t kUsualStack = rlim_t{8} << 20;

}  // namespace

void require_stack() {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= kLeastStack) return;
  const rlimit wider{std::min(kUsualStack, stack.rlim_max), stack.rlim_max};
  if (wider.rlim_cur >= kLeastStack && ::setrlimit(RLIMIT_STACK, &wider) == 0) return;
  core::fail_run({},
                 fmt::format("the stack of a process is limited to {} KiB; stride needs {} KiB",
                             stack.rlim_cur >> 10, kLeastStack >> 10),
                 "raise the limit (ulimit -s)");
}

std::string memory_hint() {
  struct Limit {
    __rlimit_resource_t resource;
    const char* option;
  };
  constexpr Limit kLimits[] = {{RLIMIT_AS, "-v"}, {RLIMIT_DATA, "-d"}};
  std::vector<std::string> found;
  for (const auto& [resource, option] : kLimits) {
    rlimit limit{};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    found.push_back(fmt::format("{} MiB (ulimit {})", limit.rlim_cur >> 20, option));
  }
  if (found.empty()) return "end other programs, or use a machine with more memory";
  return fmt::format("this process may have {} of memory: raise the limit",
                     fmt::join(found, " and "));
}

}  // namespace stride::cli
