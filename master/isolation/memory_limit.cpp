#include "master/isolation/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include "master/isolation/process/descriptor.h"
#include "master/isolation/process/process_memory.h"

namespace stride::host {

void limit_memory(std::uint64_t bytes) {
  const rlim_t most = process::data_memory(::getpid()) + bytes;
  const rlimit limit{most, most};
  if (::setrlimit(RLIMIT_DATA, &limit) != 0) process::fail("setrlimit(RLIMIT_DATA)");
}

}  // namespace stride::host
