// What a forked process has to put in order before it does anything else.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_SURROUNDINGS_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_SURROUNDINGS_H

#include <csignal>
#include <initializer_list>

#include <sys/types.h>

namespace stride::isolation {

/// Restores the default action of all signals and unblocks them; disables core dumps.
void reset_signal_handlers();

/// Standard input is empty; standard output and error go to this file.
void redirect_standard_files(int output);

/// This process gets the signal when the thread that has forked it ends; it ends at once if that
/// has happened already.
void end_with(pid_t parent, int signal = SIGKILL);

/// Closes all files but the standard ones and these.
void close_other_files(std::initializer_list<int> kept);

}  // namespace stride::isolation

#endif
