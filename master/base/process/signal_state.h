// The signals that stride depends on: their handlers, and whether they are blocked.
#ifndef STRIDE_MASTER_BASE_PROCESS_SIGNAL_STATE_H
#define STRIDE_MASTER_BASE_PROCESS_SIGNAL_STATE_H

#include <algorithm>
#include <array>
#include <csignal>
#include <string>
#include <vector>

namespace stride::core {

/// The signals by which a process ends that has damaged itself.
inline constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP};

inline bool is_crash(int signal) noexcept {
  return std::find(kCrashes.begin(), kCrashes.end(), signal) != kCrashes.end();
}

/// Those that end or interrupt a run, that a write may raise, and that the end of a child does.
inline constexpr std::array kNotices{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGCHLD};

/// The actions of these signals, whether the calling thread blocks them, and the stack of its
/// handlers.
class SignalState {
 public:
  SignalState();

  /// Puts back what differs, and adds it to `changes`, in words. A function that handles a crash
  /// is left: the runtimes of Java, Go and .NET need theirs, and pass on what is not for them.
  void restore(std::vector<std::string>& changes) const;

 private:
  std::array<struct sigaction, kCrashes.size()> crashes_{};
  std::array<struct sigaction, kNotices.size()> notices_{};
  sigset_t blocked_{};
  stack_t stack_{};
};

}  // namespace stride::core

#endif
