#include "master/base/process/signal_state.h"

#include <cstring>
#include <span>

namespace stride::core {
namespace {

std::string signal_text(const char* what, int signal) {
  return std::string(what) + " SIG" + ::sigabbrev_np(signal);
}

bool is_function(const struct sigaction& action) {
  return action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
}

/// The C library has flags of its own among them.
constexpr int kFlags = SA_NOCLDSTOP | SA_NOCLDWAIT | SA_SIGINFO | SA_ONSTACK | SA_RESTART |
                       SA_NODEFER | static_cast<int>(SA_RESETHAND);

bool is_same(const struct sigaction& a, const struct sigaction& b) {
  return a.sa_handler == b.sa_handler && (a.sa_flags & kFlags) == (b.sa_flags & kFlags);
}

bool is_same(const stack_t& a, const stack_t& b) {
  if (((a.ss_flags | b.ss_flags) & SS_DISABLE) != 0) return a.ss_flags == b.ss_flags;
  return a.ss_sp == b.ss_sp && a.ss_size == b.ss_size;
}

void capture_actions(std::span<const int> signals, std::span<struct sigaction> actions) {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], nullptr, &actions[i]);
}

void restore_actions(std::span<const int> signals, std::span<const struct sigaction> actions,
                     bool leaves_functions, std::vector<std::string>& changes) {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    struct sigaction now {};
    ::sigaction(signals[i], nullptr, &now);
    if (is_same(now, actions[i]) || (leaves_functions && is_function(now))) continue;
    ::sigaction(signals[i], &actions[i], nullptr);
    changes.push_back(signal_text("the handler of", signals[i]));
  }
}

}  // namespace

SignalState::SignalState() {
  capture_actions(kCrashes, crashes_);
  capture_actions(kNotices, notices_);
  ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked_);
  ::sigaltstack(nullptr, &stack_);
}

void SignalState::restore(std::vector<std::string>& changes) const {
  restore_actions(kNotices, notices_, false, changes);
  restore_actions(kCrashes, crashes_, true, changes);
  sigset_t now;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &now);
  for (const std::span<const int> signals : {std::span<const int>(kNotices), {kCrashes}}) {
    for (const int signal : signals) {
      if (sigismember(&now, signal) == sigismember(&blocked_, signal)) continue;
      sigset_t changed;
      ::sigemptyset(&changed);
      ::sigaddset(&changed, signal);
      ::pthread_sigmask(sigismember(&now, signal) != 0 ? SIG_UNBLOCK : SIG_BLOCK, &changed,
                        nullptr);
      changes.push_back(signal_text("the blocking of", signal));
    }
  }
  stack_t stack{};
  ::sigaltstack(nullptr, &stack);
  if (is_same(stack, stack_) || ::sigaltstack(&stack_, nullptr) != 0) return;
  changes.emplace_back("the stack of signal handlers");
}

}  // namespace stride::core
