#include "master/base/process/host_name.h"

#include <climits>

#include <unistd.h>

namespace stride::core {

std::string host_name() {
  char name[HOST_NAME_MAX + 1] = {};
  const bool is_known = ::gethostname(name, HOST_NAME_MAX) == 0 && name[0] != '\0';
  return is_known ? name : "localhost";
}

}  // namespace stride::core
