// A unit's process, as the master sees it.
#ifndef STRIDE_MASTER_LOADER_PROCESS_HOST_PROCESS_H
#define STRIDE_MASTER_LOADER_PROCESS_HOST_PROCESS_H

#include <functional>
#include <optional>
#include <string>

#include <sys/types.h>

#include "master/base/child_process/descriptor.h"
#include "master/base/files/file_identity.h"
#include "master/loader/process/host_link.h"
#include "master/loader/process/supervisor.h"

namespace stride::isolation {

/// A supervisor and the process that it keeps. Nothing of them stays when the object is destroyed.
class HostProcess {
 public:
  /// Forks. `serve` is called in the unit's process, with the process id of its parent; that
  /// process ends when it returns. Throws std::system_error if there can be no process.
  HostProcess(HostLink& link, MemoryAllowance memory, const std::function<void(pid_t)>& serve);
  ~HostProcess() {
    finish([] {});
  }
  HostProcess(const HostProcess&) = delete;
  HostProcess& operator=(const HostProcess&) = delete;

  /// Whether the unit had no active process any longer when that was looked for.
  bool has_ended() const { return end_.how != HostEnd::How::None; }
  /// Looks whether it has one; also whether the supervisor runs: if it was stopped it is continued,
  /// and if it was ended the unit's process is, too.
  bool look_for_end();
  /// Ends the unit's process.
  void kill();
  /// Ends everything and waits for it; calls `meanwhile` again and again, which may read what is
  /// printed. A supervisor that does not end in time is killed, with all that it supervises.
  void finish(const std::function<void()>& meanwhile);

  /// Whether it could not be started, for want of processes or memory.
  bool has_lacked_something() const;
  /// "its process was killed by SIGSEGV (signal 11)"
  std::string how_it_ended() const;
  /// What may help, where that is known.
  std::string hint() const;

 private:
  void send(Command command) const;
  bool take_end();
  bool has_control() const;
  bool is_supervisor_gone() const;
  void continue_supervisor() const;
  void force_end() const;

  HostLinkMemory& link_;
  const MemoryAllowance memory_;
  Descriptor control_;
  std::optional<core::FileIdentity> control_file_;
  pid_t supervisor_ = 0;
  bool is_supervisor_lost_ = false;
  bool is_control_lost_ = false;  ///< so the supervisor took the master for ended
  HostEnd end_;
};

}  // namespace stride::isolation

#endif
