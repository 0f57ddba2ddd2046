// The memory that the process may have.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_MEMORY_LIMITS_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_MEMORY_LIMITS_H

#include <string>

namespace stride::cli {

/// Raises a limit of the stack (ulimit -s) below that which stride needs. Throws core::Error (Run)
/// if that is not allowed, in place of a crash later.
void require_stack();

/// What to do where there is not enough memory: which limit of the process to raise, if it has one.
std::string memory_hint();

}  // namespace stride::cli

#endif
