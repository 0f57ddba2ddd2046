// The resource limits of stride, which code of units in its process may not lower for good.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_HARD_LIMITS_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_HARD_LIMITS_H

namespace stride::cli {

/// From here on setrlimit() and prlimit(), whichever code in this process calls them, leave the
/// hard limits of the process as they are: without privileges a lowered one could not be put back,
/// and what the end of a run needs, such as open files, would be lacking. Soft limits are changed,
/// and put back by core::ProcessState. In forks of the process both are changed. A system call that
/// is made without the C library is not covered.
void keep_hard_limits();

}  // namespace stride::cli

#endif
