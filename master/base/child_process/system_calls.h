// The kernel's filter of system calls (seccomp).
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_SYSTEM_CALLS_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_SYSTEM_CALLS_H

namespace stride::isolation {

/// Each holds for this thread and for all that it starts, and for each of the machine's interfaces
/// that a call may come by (a 32-bit program's, too); EACCES is the answer to what is denied. Needs
/// no_new_privs. Throws std::system_error if the kernel takes no such filter; then nothing has
/// changed.

/// No socket but AF_UNIX, also not by way of io_uring.
void forbid_network();

/// No call that names another process (or a thread, by its number), and nothing that is shared with
/// other processes by a key or a name: limits, priorities, processors, memory and files of others,
/// System V memory, semaphores and queues, POSIX queues, keys of the kernel, performance counters,
/// leases on files. Signals and debuggers are Landlock's
/// matter.
void forbid_reaching_processes();

/// Nothing that changes the system or what a process sees of it, and that no simulation needs:
/// namespaces, mounts and other roots of the file system, modules and programs in the kernel,
/// memory that is hidden from the kernel or filled in by the process (memfd_secret, userfaultfd),
/// segments and I/O ports of the processor, watches over whole file systems, the kernel's log, the
/// clock, names, quotas, swap space and accounting. Most of it needs privileges that a unit lacks;
/// without these calls it cannot make a namespace in which it has them. clone3(), whose flags a
/// filter cannot see, answers ENOSYS: the C library takes clone() instead.
void forbid_administration();

/// No system call that is newer than Linux 6.4: the answer is ENOSYS, as of an older kernel. So no
/// call escapes the other filters because they were made before it was.
void forbid_newer_calls();

/// No change of owners, times, extended attributes and modes: neither of the user's files nor of
/// its own, since a filter cannot tell them apart. A change of modes answers that it is done: what
/// copies a file changes its mode, too, and goes on. A file gets its mode when it is made.
void forbid_changing_attributes();

/// Requests to devices and file systems (ioctl) answer ENOTTY, as if they knew none, but for those
/// to /dev/dri and a few that change nothing for others: FIONREAD, FIONBIO, FIOASYNC, FIOCLEX,
/// FIONCLEX and TCGETS.
void forbid_requests();

/// Locks on files (flock(), and those of fcntl()) do nothing, and answer that they are had: a lock
/// of a file that can only be read would keep other programs waiting.
void ignore_locks();

/// No thread has open files of its own, which those who count them would not see; and no sendmsg()
/// and sendmmsg(), by which open files are sent through a socket. A filter cannot see whether there
/// are any; send() and write() carry none.
void forbid_hiding_files();

/// No cutting off of files by their names, or when they are opened for reading.
void forbid_truncation();

}  // namespace stride::isolation

#endif
