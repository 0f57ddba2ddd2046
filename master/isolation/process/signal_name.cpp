#include "master/isolation/process/signal_name.h"

#include <cstring>

namespace stride::process {

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name != nullptr ? std::string("SIG") + name : "an unknown signal";
}

}  // namespace stride::process
