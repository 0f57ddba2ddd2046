// Functions of the C library that end the process, or put another program in its place, as code in
// this process reaches them: _exit(), _Exit(), daemon(), the exec functions, and such system calls
// by syscall(). In a guarded process each is an error (report_end()); in others, such as forks
// of it, they are the C library's. Its own use of them, as in system() and posix_spawn(), stays.
#ifndef STRIDE_MASTER_CLI_REPLACED_CALLS_H
#define STRIDE_MASTER_CLI_REPLACED_CALLS_H

namespace stride::cli {

/// The C library's syscall().
long system_call(long number, long argument);

}  // namespace stride::cli

#endif
