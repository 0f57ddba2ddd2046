// What a process gives up for good, before it loads code of unknown origin.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_SANDBOX_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_SANDBOX_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace stride::isolation {

/// What is in force and what is not, each in words, for a person to read.
struct Protections {
  std::vector<std::string> in_force;  ///< "no network: seccomp"
  std::vector<std::string> missing;   ///< what this kernel or container does not offer, and why
};

/// Where files may still be changed.
struct WritableFolder {
  std::filesystem::path path;
  std::string name;  ///< what the protections call it
};

/// Takes from this process, and from all that it will ever start, what a unit has no need of. No
/// root is needed, and nothing is ended: what is denied fails with EACCES (or EPERM, a signal).
///
/// - no new privileges: a set-user-ID program gains nothing; of root's own privileges only those
///   stay that give access to files;
/// - no core dump, and as many open files as a program uses, so that one which leaks them fails
///   before the machine does. The number of processes is not limited: the kernel counts those of
///   the user, not those of a unit;
/// - files are only read and executed, but for what is in the folders `writable` and below, and
///   /dev/null and its like. Nothing is made, removed, renamed, truncated or mounted elsewhere.
///   What is open already is not covered. No terminal or other device is opened, but for /dev/null
///   and its like, and those for rendering (Landlock);
/// - requests to files and devices (ioctl) answer ENOTTY, but for a few without effect on others
///   (seccomp);
/// - owners, times, attributes and modes of files are not changed, wherever they are; a change of
///   modes answers that it is done (seccomp);
/// - no call names another process, and nothing is shared by a key or a name (seccomp);
/// - locks on files do nothing, and answer that they are had (seccomp);
/// - no namespaces, mounts and other changes of the system (seccomp);
/// - signals reach, and debuggers attach to, processes in the same sandbox only;
/// - no socket but AF_UNIX (seccomp);
/// - no system calls newer than Linux 6.4 (seccomp);
/// - with `has_memory_limit`, no files are sent through sockets, and no thread has open files of
/// its
///   own (seccomp): files in memory would escape the watch over it.
///
/// The answer lists what the kernel lacks; the rest is in force. To be called while this
/// process has one thread. Throws std::system_error if a folder cannot be opened.
Protections enter_sandbox(std::span<const WritableFolder> writable, bool has_memory_limit = false);

}  // namespace stride::isolation

#endif
