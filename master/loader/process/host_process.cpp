#include "master/loader/process/host_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/children.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::isolation {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// For the supervisor, which forwards what was printed for a second at most.
constexpr std::chrono::seconds kLongestEnd{5};

struct ControlSocket {
  Descriptor ours, theirs;

  // a socket, since a write to a closed pipe raises SIGPIPE
  ControlSocket() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      fail("socketpair");
    }
    ours = Descriptor(ends[0]);
    theirs = Descriptor(ends[1]);
  }
};

/// What waits in this process to be written would be written by its forks, too.
void flush_standard_files() {
  std::cout.flush();
  std::cerr.flush();
  std::clog.flush();
  std::fflush(nullptr);
}

}  // namespace

HostProcess::HostProcess(HostLink& link, MemoryAllowance memory,
                         const std::function<void(pid_t)>& serve)
    : link_(*link.memory), memory_(std::move(memory)) {
  ControlSocket control;
  flush_standard_files();
  const pid_t master = ::getpid();
  supervisor_ = ::fork();
  if (supervisor_ < 0) fail("fork");
  if (supervisor_ == 0) {
    control.ours.close();
    supervise(link, std::move(control.theirs), master, memory_, serve);
  }
  control_ = std::move(control.ours);
  control_file_ = core::FileIdentity::of(control_.number());
  link.memory.hide_from_children();
  link.packets.hide_from_children();
}

bool HostProcess::look_for_end() {
  if (has_ended() || take_end()) return true;
  if (!is_supervisor_gone()) {
    continue_supervisor();
    return false;
  }
  ::kill(-supervisor_, SIGKILL);
  is_supervisor_lost_ = true;
  is_control_lost_ = !has_control();
  end_ = {HostEnd::How::Killed, SIGKILL};
  return true;
}

/// What the supervisor has sent, if it has.
bool HostProcess::take_end() {
  HostEnd end;
  if (::recv(control_.number(), &end, sizeof end, MSG_DONTWAIT) != sizeof end) return false;
  end_ = end;
  return true;
}

void HostProcess::kill() {
  send(Command::Kill);
  for (auto time_left = 2000ms; !look_for_end() && time_left > 0ms; time_left -= 1ms) {
    std::this_thread::sleep_for(1ms);
  }
}

void HostProcess::finish(const std::function<void()>& meanwhile) {
  if (supervisor_ <= 0) return;
  send(Command::Finish);
  if (!has_control()) control_.release();
  control_.close();
  const auto enough = Clock::now() + kLongestEnd;
  while (!is_supervisor_gone() && Clock::now() < enough) {
    continue_supervisor();
    const std::uint32_t rings = link_.reply.doorbell.rings();
    meanwhile();
    link_.reply.doorbell.sleep(rings, 1ms);
  }
  if (!is_supervisor_gone()) force_end();
  ::kill(-supervisor_, SIGKILL);  // in vain, unless something has ended the supervisor
  int status = 0;
  while (::waitpid(supervisor_, &status, 0) < 0 && errno == EINTR) {
  }
  supervisor_ = 0;
}

/// It has not been waited for yet, so its group still has its number; unless a unit in this process
/// has done so, or ignores the end of processes.
bool HostProcess::is_supervisor_gone() const {
  siginfo_t info{};
  const int options = WEXITED | WNOWAIT | WNOHANG;
  if (::waitid(P_PID, static_cast<id_t>(supervisor_), &info, options) != 0) return errno == ECHILD;
  return info.si_pid == supervisor_;
}

/// Has no effect on one that runs. Nothing is done about a unit's process that was stopped: it may
/// have been stopped to be looked at, and the limit of a call ends it.
void HostProcess::continue_supervisor() const {
  siginfo_t info{};
  ::waitid(P_PID, static_cast<id_t>(supervisor_), &info, WSTOPPED | WNOHANG);
  if (info.si_pid == supervisor_) ::kill(supervisor_, SIGCONT);
}

/// The processes of the unit, and then the supervisor, whose children they all become one after the
/// other. It is stopped, so it waits for none of them, and their numbers stay theirs.
void HostProcess::force_end() const {
  ::kill(supervisor_, SIGSTOP);
  const auto enough = Clock::now() + kLongestEnd;
  while (kill_children_of(supervisor_) && Clock::now() < enough) std::this_thread::sleep_for(1ms);
  ::kill(supervisor_, SIGKILL);
}

/// Code in this process may have closed the file, or put another one in its place.
bool HostProcess::has_control() const {
  return core::FileIdentity::of(control_.number()) == control_file_;
}

void HostProcess::send(Command command) const {
  ::send(control_.number(), &command, sizeof command, MSG_NOSIGNAL);
}

bool HostProcess::has_lacked_something() const {
  return end_.how == HostEnd::How::NotStarted &&
         core::is_of_environment(std::system_error(end_.code, std::generic_category()));
}

std::string HostProcess::how_it_ended() const {
  if (is_control_lost_) {
    return fmt::format(
        "its process has ended, since code in the process of stride, such as that of a unit "
        "without a host{}, has closed the open file by which it is led, or put another one in its "
        "place",
        importer::names_in_brackets(importer::library_users()));
  }
  if (is_supervisor_lost_)
    return "its process was killed, since something has ended its supervisor";
  using How = HostEnd::How;
  const auto [how, code] = end_;
  switch (how) {
    case How::NotStarted:
      return fmt::format("its process cannot be started: {}", std::strerror(code));
    case How::Exited:
      return fmt::format("it ended its process with exit code {}", code);
    case How::OverLimit:
      return fmt::format(
          "its processes took {} MiB of memory together, which is above the limit of {} MiB, so "
          "they were ended",
          code, memory_.limit.value_or(0) >> 20);
    case How::Killed:
    case How::None:
      break;
  }
  return fmt::format("its process was ended by signal {} ({})", code, signal_name(code));
}

std::string HostProcess::hint() const {
  return is_control_lost_ ? "a unit may close its own files only; with --isolate it has no others"
                          : "";
}

}  // namespace stride::isolation
