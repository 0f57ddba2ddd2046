#include "master/base/child_process/process_memory.h"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {
namespace {

/// The sum of these lines of a file, which are in KiB: "VmHWM:      1234 kB".
std::uint64_t sum_of(std::initializer_list<std::string_view> titles, pid_t process,
                     const std::string& file) {
  std::ifstream lines("/proc/" + std::to_string(process) + "/" + file);
  std::uint64_t sum = 0;
  for (std::string word; lines >> word;) {
    std::uint64_t kibibytes = 0;
    const bool is_wanted = std::find(titles.begin(), titles.end(), word) != titles.end();
    if (is_wanted && lines >> kibibytes) sum += kibibytes * 1024;
  }
  return sum;
}

}  // namespace

std::uint64_t most_memory(pid_t process) { return sum_of({"VmHWM:"}, process, "status"); }

std::uint64_t private_memory(pid_t process) {
  return sum_of({"Private_Clean:", "Private_Dirty:"}, process, "smaps_rollup");
}

std::uint64_t data_memory(pid_t process) {
  return sum_of({"VmData:", "VmStk:"}, process, "status");
}

std::optional<std::uint64_t> proportional_memory(pid_t process) {
  const std::uint64_t bytes =
      sum_of({"Pss_Anon:", "Private_Hugetlb:", "Shared_Hugetlb:"}, process, "smaps_rollup");
  return bytes > 0 ? std::optional(bytes) : std::nullopt;
}

std::uint64_t unshared_bound(pid_t process) {
  return sum_of({"RssAnon:", "RssShmem:", "VmSwap:", "HugetlbPages:"}, process, "status");
}

void limit_memory(std::uint64_t bytes) {
  const rlim_t most = data_memory(::getpid()) + bytes;
  const rlimit limit{most, most};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) fail("setrlimit(RLIMIT_DATA)");
}

}  // namespace stride::isolation
