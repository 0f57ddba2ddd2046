#ifndef STRIDE_MASTER_LOADER_PROCESS_SUPERVISOR_H
#define STRIDE_MASTER_LOADER_PROCESS_SUPERVISOR_H

#include <cstdint>
#include <functional>

#include <sys/types.h>

#include "master/base/child_process/descriptor.h"
#include "master/loader/process/host_link.h"
#include "master/loader/process/memory_watch.h"

namespace stride::isolation {

/// What the master sends to a supervisor through the control socket; its end is the end of the
/// master.
enum class Command : char {
  Kill = 'K',    ///< end the unit's process, and report how it ended
  Finish = 'F',  ///< end, and leave nothing
};

/// How the unit's process ended: what a supervisor sends back through the socket, once. It is not
/// in shared memory, where the unit could write it.
struct HostEnd {
  enum class How : std::uint32_t {
    None,
    NotStarted,  ///< `code` is the error
    Exited,      ///< the exit code
    Killed,      ///< the signal
    OverLimit,   ///< killed, since all its processes together took so much memory [MiB]
  };
  How how = How::None;
  int code = 0;
};

/// Supervises a unit's process, which it forks: it passes on what that process prints, notes how it
/// ends, ends it with all its children when together they take more memory than `memory` allows, or
/// when the master is gone, whose temporary folders it then removes. To be called in a fresh fork
/// of the master.
///
/// `serve` is called in the unit's process, with the supervisor's process id.
[[noreturn]] void supervise(HostLink& link, Descriptor control, pid_t master,
                            const MemoryAllowance& memory,
                            const std::function<void(pid_t)>& serve) noexcept;

}  // namespace stride::isolation

#endif
