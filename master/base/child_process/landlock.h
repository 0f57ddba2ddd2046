// The kernel's Landlock: a file system that is read-only but for some folders, without devices.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_LANDLOCK_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_LANDLOCK_H

#include <span>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {

/// The version of Landlock's interface (kernel documentation, userspace-api/landlock). Throws
/// std::system_error if the kernel has none, if it is switched off, or not allowed here.
int landlock_version();

/// From these versions on.
constexpr int kLandlockTruncates = 3;  ///< truncation without writing is seen, too
constexpr int kLandlockRequests = 5;   ///< requests to devices (ioctl) are seen
constexpr int kLandlockSignals = 6;    ///< signals stay within

/// Leaves to this thread, and to all that it starts, no way to change the file system but in these
/// folders (opened with O_PATH), in the files among them, and in a few devices without effect such
/// as /dev/null. No other device in /dev is opened, also not for reading: no terminal, disk or
/// virtual machine. What a folder of / has that does not exist yet cannot be read. Needs
/// no_new_privs. Throws std::system_error; then nothing has changed.
void restrict_files(std::span<const Descriptor> writable, int version);

}  // namespace stride::isolation

#endif
