// What a unit's process and the master have in common: requests, replies, and logged and printed
// lines.
#ifndef STRIDE_MASTER_LOADER_PROCESS_HOST_LINK_H
#define STRIDE_MASTER_LOADER_PROCESS_HOST_LINK_H

#include <atomic>
#include <cstddef>
#include <cstdint>

#include <sys/types.h>

#include "master/base/child_process/doorbell.h"
#include "master/base/child_process/shared_memory.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/loader/process/byte_ring.h"
#include "master/loader/process/snapshot_board.h"
#include "master/loader/wire/calls.h"

namespace stride::isolation {

/// What a unit's process is taken for where what it has written cannot be.
inline constexpr const char* kHasOverwritten =
    "the unit's process has written into the shared memory";

/// One direction. The writer sets what and size first, then the number, then rings.
struct alignas(64) Turn {
  std::atomic<std::uint32_t> number = 0;
  std::atomic<std::uint32_t> what = 0;  ///< a RequestCode or a ReplyCode
  std::atomic<std::uint64_t> size = 0;  ///< of the packet [byte]
  Doorbell doorbell;                    ///< for the process that waits
};

/// In shared memory. The packets themselves are in a GrowingMemory beside it, where each replaces
/// the one before. Replies have the number of their request, so neither
/// side keeps a state, and any process that becomes the active one may continue with it.
///
/// The unit's process may write anything here: sizes are checked, and what is no such value is an
/// error.
struct HostLinkMemory {
  Turn request;  ///< the unit's process waits for it
  Turn reply;    ///< the master waits for it, for the end, and for logged lines that do not fit
  std::atomic<std::uint64_t> calls = 0;  ///< of functions of the unit

  /// The active process of the unit. The end of any other does not matter.
  std::atomic<pid_t> active = 0;

  std::atomic<std::uint64_t> most_memory = 0;  ///< resident, of those that have ended [byte]
  SnapshotBoard snapshots;

  importer::CallNote call_note;
  ByteRing logged;   ///< messages of the unit, see log_message.h; written by its process
  ByteRing printed;  ///< standard output and error; written by the supervisor
};

/// Both kinds of memory. Made by the master, inherited by the others.
struct HostLink {
  Shared<HostLinkMemory> memory;
  GrowingMemory packets{"stride-unit", std::size_t{1} << 16};
};

}  // namespace stride::isolation

#endif
