// The name of this machine.
#ifndef STRIDE_MASTER_BASE_PROCESS_HOST_NAME_H
#define STRIDE_MASTER_BASE_PROCESS_HOST_NAME_H

#include <string>

namespace stride::core {

/// "localhost" if it has none.
std::string host_name();

}  // namespace stride::core

#endif
