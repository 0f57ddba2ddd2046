#include "master/loader/process/supervisor.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/child_process/children.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/outliving_memory.h"

namespace stride::isolation {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How often is looked whether the master has made room for printed lines.
constexpr int kNoRoomPause = 5;  // [ms]

/// A file that becomes readable when a child ends.
Descriptor watch_children() {
  sigset_t children;
  ::sigemptyset(&children);
  ::sigaddset(&children, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &children, nullptr);
  return Descriptor(::signalfd(-1, &children, SFD_CLOEXEC | SFD_NONBLOCK));
}

/// Those that are its own, and those whose parents have ended.
std::vector<pid_t> own_children() {
  const std::optional<std::vector<pid_t>> found = children_of(::getpid());
  if (!found) ::kill(0, SIGKILL);  // without /proc: the whole group, this one with it
  return *found;
}

class Supervisor {
 public:
  Supervisor(HostLinkMemory& link, Descriptor control, Descriptor output, MemoryWatch& memory)
      : link_(link),
        control_(std::move(control)),
        output_(std::move(output)),
        ends_(watch_children()),
        memory_(memory) {}

  /// What the supervisor sees of the fork.
  void note_start(pid_t server, int error) {
    pid_t none = 0;
    link_.active.compare_exchange_strong(none, server);
    if (server < 0) tell_end({HostEnd::How::NotStarted, error});
  }

  /// Returns true when the master requests the end, false when the master has ended.
  bool run() {
    for (;;) {
      wait();
      forward_output();
      reap();
      watch_memory();
      char command = 0;
      const ssize_t size = ::recv(control_.number(), &command, 1, MSG_DONTWAIT);
      if (size < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (size <= 0) return false;
      kill_children();
      if (static_cast<Command>(command) == Command::Finish) return true;
    }
  }

  /// What has been printed so far, if the master makes room for it in time; others may print on.
  void forward_all_output(std::chrono::milliseconds time_limit) {
    const auto enough = Clock::now() + time_limit;
    while (forward_output() && Clock::now() < enough) {
      if (!pending_.empty()) std::this_thread::sleep_for(1ms);
    }
  }

  /// Those of them that have children of their own leave these to this process.
  void kill_children() {
    for (;;) {
      const std::vector<pid_t> found = own_children();
      if (found.empty()) return;
      for (const pid_t child : found) ::kill(child, SIGKILL);
      for (const pid_t child : found) {
        int status = 0;
        rusage usage{};
        while (::wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
        }
        note_end(child, status, usage);
      }
    }
  }

 private:
  void wait() const {
    const bool has_room = pending_.empty();
    std::array<pollfd, 3> files{{{control_.number(), POLLIN, 0},
                                 {ends_.number(), POLLIN, 0},
                                 {has_room ? output_.number() : -1, POLLIN, 0}}};
    const int look = has_ended_ ? -1 : memory_.pause();
    const bool looks_first = has_room || (look >= 0 && look < kNoRoomPause);
    ::poll(files.data(), files.size(), looks_first ? look : kNoRoomPause);
  }

  void watch_memory() {
    if (has_ended_) return;
    const std::optional<std::uint64_t> used = memory_.excess();
    if (!used) return;
    has_ended_ = true;  // by this, and not by the signal
    kill_children();
    tell_end({HostEnd::How::OverLimit, static_cast<int>(*used >> 20)});
  }

  void tell_end(const HostEnd& end) {
    has_ended_ = true;
    forward_all_output(100ms);  // its output comes first
    ::send(control_.number(), &end, sizeof end, MSG_NOSIGNAL);
    link_.reply.doorbell.ring();
  }

  /// What the unit has printed, a piece of it; returns whether there was something.
  bool forward_output() {
    if (pending_.empty() && !read_some(output_, pending_)) return false;
    pending_.erase(0, link_.printed.write(pending_));
    link_.reply.doorbell.ring();
    return true;
  }

  void reap() {
    signalfd_siginfo ignored;
    while (::read(ends_.number(), &ignored, sizeof ignored) > 0) {
    }
    int status = 0;
    rusage usage{};
    for (pid_t child = 0; (child = ::wait4(-1, &status, WNOHANG, &usage)) > 0;) {
      if (WIFSTOPPED(status)) {
        let_go(child, status);
      } else {
        note_end(child, status, usage);
      }
    }
  }

  void note_end(pid_t child, int status, const rusage& usage) {
    raise_to(link_.most_memory, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
    link_.snapshots.note_end(child);
    if (has_ended_) return;
    // the unit may have overwritten which one is active
    if (child != link_.active && !own_children().empty()) return;
    if (WIFSIGNALED(status)) return tell_end({HostEnd::How::Killed, WTERMSIG(status)});
    tell_end({HostEnd::How::Exited, WEXITSTATUS(status)});
  }

  HostLinkMemory& link_;
  Descriptor control_, output_, ends_;
  MemoryWatch& memory_;
  bool has_ended_ = false;  ///< not in shared memory, where the unit could write it
  std::string pending_;     ///< printed, and there was no room for it
};

/// The master's locks are free when it is no longer there at all.
void clean_up_after(pid_t master) {
  for (int i = 0; i < 1000 && ::getppid() == master; ++i) std::this_thread::sleep_for(1ms);
  archive::TemporaryFolder::sweep_abandoned();
}

/// The unit's process, which never returns.
[[noreturn]] void run_server(HostLink& link, const Pipe& output, pid_t supervisor,
                             const std::function<void(pid_t)>& serve) {
  end_with(supervisor);
  link.memory->active = ::getpid();  // which may be another one when the supervisor looks
  redirect_standard_files(output.write.number());
  close_other_files({link.packets.file().number()});
  serve(supervisor);
  ::_exit(0);
}

}  // namespace

void supervise(HostLink& link, Descriptor control, pid_t master, const MemoryAllowance& memory,
               const std::function<void(pid_t)>& serve) noexcept {
  core::OutlivingMemory::leave();
  ::setsid();  // without a terminal, and in a group of its own
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::prctl(PR_SET_NAME, "unit-supervisor");
  reset_signal_handlers();
  const Descriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
  redirect_standard_files(nowhere.number());
  close_other_files({control.number(), link.packets.file().number()});
  Pipe output;
  MemoryWatch watch(memory);
  const pid_t self = ::getpid();
  const pid_t server = ::fork();
  const int error = errno;
  if (server == 0) run_server(link, output, self, serve);
  output.write.close();
  Supervisor supervisor(*link.memory, std::move(control), std::move(output.read), watch);
  supervisor.note_start(server, error);
  const bool is_wanted = supervisor.run();
  supervisor.kill_children();
  if (is_wanted) {
    supervisor.forward_all_output(1000ms);
  } else {
    clean_up_after(master);
  }
  ::_exit(0);
}

}  // namespace stride::isolation
