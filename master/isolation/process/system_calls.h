// The kernel's filter of system calls (seccomp).
#ifndef STRIDE_MASTER_ISOLATION_PROCESS_SYSTEM_CALLS_H
#define STRIDE_MASTER_ISOLATION_PROCESS_SYSTEM_CALLS_H

namespace stride::isolation {

/// Each holds for this thread and for all that it starts, and for each of the machine's interfaces
/// that a call may come by (a 32-bit program's, too); EACCES is the answer to what is denied. Needs
/// no_new_privs. Throws std::system_error if the kernel takes no such filter; then nothing has
/// changed.

/// No socket but AF_UNIX, also not by way of io_uring, and no typing into a terminal.
void forbid_network();

/// No cutting off of files by their names, or when they are opened for reading.
void forbid_truncation();

}  // namespace stride::isolation

#endif
