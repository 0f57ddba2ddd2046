#ifndef STRIDE_MASTER_ISOLATION_SUPERVISOR_H
#define STRIDE_MASTER_ISOLATION_SUPERVISOR_H

#include <functional>

#include <sys/types.h>

#include "master/isolation/channel.h"
#include "master/isolation/process/descriptor.h"

namespace stride::host {

/// What the master tells a supervisor through its line; the end of the line is the end of the
/// master.
enum class Command : char {
  Kill = 'K',    ///< end the unit's process, and tell how it ended
  Finish = 'F',  ///< end, and leave nothing
};

/// The life of a process that stands between the master and a unit's process, which it forks: it
/// passes on what that prints, tells how it ends, and ends all that comes from it when the master
/// is gone, whose temporary folders it then removes. To be called in a fresh fork of the master.
///
/// `serve` is called in the unit's process, with the supervisor's process id.
[[noreturn]] void supervise(Channel& channel, process::Descriptor line, pid_t master,
                            const std::function<void(pid_t)>& serve) noexcept;

}  // namespace stride::host

#endif
