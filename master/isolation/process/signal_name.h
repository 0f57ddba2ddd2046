#ifndef STRIDE_MASTER_ISOLATION_PROCESS_SIGNAL_NAME_H
#define STRIDE_MASTER_ISOLATION_PROCESS_SIGNAL_NAME_H

#include <string>

namespace stride::process {

/// "SIGSEGV"
std::string signal_name(int signal);

}  // namespace stride::process

#endif
