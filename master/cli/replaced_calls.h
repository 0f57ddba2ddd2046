// Functions of the C library that end the process, or put another program in its place, as code in
// this process reaches them: _exit(), _Exit(), daemon(), the exec functions, and such system calls
// by syscall(). The C library's own use of them, as in system() and posix_spawn(), stays.
#ifndef STRIDE_MASTER_CLI_REPLACED_CALLS_H
#define STRIDE_MASTER_CLI_REPLACED_CALLS_H

namespace stride::cli {

/// From here on report(name of the function) is called before each of them; where it returns, the C
/// library's function is called. It may be called in a fork of this process, too.
void watch_ends(void (*report)(const char* function));

/// The C library's syscall(), without a report.
long system_call(long number, long argument);

}  // namespace stride::cli

#endif
