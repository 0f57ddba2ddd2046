#include "master/host/memory_limit.h"

#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

#include "master/process/descriptor.h"

namespace stride::host {
namespace {

/// What counts for RLIMIT_DATA (proc(5), statm).
std::uint64_t data_size() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  file >> size >> resident >> shared >> text >> library >> data;
  return data * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void limit_memory(std::uint64_t bytes) {
  const rlim_t most = data_size() + bytes;
  const rlimit limit{most, most};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) process::fail("setrlimit(RLIMIT_DATA)");
}

}  // namespace stride::host
