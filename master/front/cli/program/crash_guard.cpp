#include "master/front/cli/program/crash_guard.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <new>
#include <string>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/error.h"
#include "master/base/files/output_file.h"
#include "master/base/process/own_exit.h"
#include "master/base/process/signal_state.h"
#include "master/front/cli/program/crash_error.h"
#include "master/front/cli/program/end_note.h"
#include "master/front/cli/program/exit.h"
#include "master/front/cli/program/output.h"
#include "master/loader/fmu/instance/present_call.h"
#include "master/loader/fmu/instance/unit_call.h"

namespace stride::cli {
namespace {

using core::kCrashes;

/// Of virtual memory: the conclusion runs on it.
constexpr std::size_t kStackSize = std::size_t{8} << 20;

/// Other signals that would end the process without a word, beside those of real time.
constexpr std::array kEndings{SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF,   SIGUSR1,
                              SIGUSR2, SIGIO,   SIGPWR,    SIGSTKFLT, SIGXCPU};
constexpr int kFirstHidden = 32;  ///< of those that the C library keeps to itself

/// What handlers, which have no arguments, have to know.
struct Guarded {
  std::atomic<const CrashGuard::Conclusion*> conclusion{nullptr};
  std::atomic<pid_t> process{0};
  std::atomic<pid_t> ending{0};  ///< the thread that ends the process
  timer_t time_limit{};          ///< for the end of the process
  bool has_time_limit = false;
  std::size_t steps = 0;  ///< to the end that have begun, by the thread that ends the process
};
Guarded guarded;

// ---- The steps to the end of a process that a unit has damaged ----

/// In the fork.
[[noreturn]] void conclude() {
  try {
    EndNote& note = end_note();
    const UnitWork work{.calls = importer::unfinished_calls(note.end.thread),
                        .library = importer::unfinished_library_work(),
                        .last = importer::last_call_of_this_thread(),
                        .users = importer::library_users(),
                        .is_leaving = bool(note.is_leaving),
                        .has_locked_output = is_output_locked()};
    ignore_output_locks();
    const core::Error error = error_of(note.end, work);
    note.error.set(error.what());
    note.is_printed.set(print_error(error.what()));
    (*guarded.conclusion.load())(error.what());
  } catch (...) {  // the rest is lost
  }
  archive::TemporaryFolder::remove_all(guarded.process);
  ::_exit(kRunFailed);
}

/// Returns whether the process has ended by itself, and not by a signal.
bool wait_for(pid_t process) {
  constexpr timespec kPause{0, 10'000'000};
  for (int pauses = 0; pauses < 1000; ++pauses) {
    int status = 0;
    const pid_t ended = ::waitpid(process, &status, WNOHANG);
    if (ended == process) return WIFEXITED(status);
    if (ended < 0 && errno != EINTR) return false;
    ::nanosleep(&kPause, nullptr);
  }
  ::kill(process, SIGKILL);
  return false;
}

/// Calls work() in a fork; returns whether it came to its end there.
bool is_done_in_fork(void (*work)()) {
  const pid_t fork = ::_Fork();
  if (fork == 0) {
    for (const int other : kCrashes) ::signal(other, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    work();
  }
  return fork > 0 && wait_for(fork);
}

[[noreturn]] void end_complete() {
  EndNote& note = end_note();
  const bool is_from_outside =
      note.end.kind == ProcessEnd::Kind::Signal && note.end.origin == SignalOrigin::Outside;
  note.code = is_from_outside ? -note.end.number : kRunFailed;
  note.is_complete.set();
  if (is_from_outside) end_by(note.end.number);
  ::_exit(kRunFailed);
}

[[noreturn]] void wait_for_end() {
  for (;;) ::pause();
}

/// So that the results do not go on meanwhile. Their handlers call end_process().
void stop_other_threads() {
  constexpr timespec kUntilTheyHaveStopped{0, 2'000'000};
  const pid_t self = ::gettid();
  const int tasks = ::open("/proc/self/task", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (tasks < 0) return;
  alignas(dirent64) std::array<char, 4096> entries{};
  for (long size = 0;
       (size = ::syscall(SYS_getdents64, tasks, entries.data(), entries.size())) > 0;) {
    for (long at = 0; at < size;) {
      const auto& entry = *reinterpret_cast<const dirent64*>(entries.data() + at);
      const pid_t thread = std::atoi(entry.d_name);
      if (thread > 0 && thread != self) ::syscall(SYS_tgkill, ::getpid(), thread, SIGABRT);
      at += entry.d_reclen;
    }
  }
  ::close(tasks);
  ::nanosleep(&kUntilTheyHaveStopped, nullptr);
}

/// After the command no conclusion has put the error into the files.
void report() {
  if (is_done_in_fork(conclude) && !end_note().is_leaving) end_complete();
}

/// A crash in one of them goes on with the next one.
constexpr void (*kSteps[])() = {stop_other_threads, core::OutputFile::rescue_all, report};

[[noreturn]] void end_process(const ProcessEnd& end) {
  sigset_t blocked;
  ::sigfillset(&blocked);
  for (const int crash : kCrashes) ::sigdelset(&blocked, crash);
  ::pthread_sigmask(SIG_SETMASK, &blocked, nullptr);
  pid_t ending = 0;
  const pid_t self = ::gettid();
  if (guarded.ending.compare_exchange_strong(ending, self)) {
    EndNote& note = end_note();
    note.is_complete.set(false);
    note.end = end;
    note.end.thread = &importer::this_thread;
    note.has_end.set();
  } else if (ending != self) {
    wait_for_end();
  }
  while (guarded.steps < std::size(kSteps)) kSteps[guarded.steps++]();
  // not complete: a process that watches this one says what has happened
  if (end.kind == ProcessEnd::Kind::Signal) end_by(end.number);
  ::_exit(kRunFailed);
}

/// Forks of a guarded process, such as those of hosts, are not guarded.
bool is_guarded() { return guarded.conclusion.load() != nullptr && guarded.process == ::getpid(); }

// ---- Signals ----

/// As the kernel has it, so that the C library does not keep its own signals to itself.
struct alignas(8) KernelAction {
  std::array<unsigned char, 64> bytes{};

  static KernelAction of(int signal) {
    KernelAction action;
    ::syscall(SYS_rt_sigaction, signal, nullptr, action.bytes.data(), kSetSize);
    return action;
  }
  void set(int signal) const {
    ::syscall(SYS_rt_sigaction, signal, bytes.data(), nullptr, kSetSize);
  }
  bool operator==(const KernelAction&) const = default;

  static constexpr long kSetSize = 8;
};

/// Of the limit for the end of the process, and not one of a unit's timers.
bool is_time_limit(const siginfo_t& info) {
  return info.si_code == SI_TIMER && info.si_value.sival_ptr == &guarded;
}

constexpr itimerspec kNever{};

void begin_time_limit() {
  const itimerspec limit{{}, {kLongestEnd, 0}};
  if (guarded.has_time_limit) ::timer_settime(guarded.time_limit, 0, &limit, nullptr);
}

/// What takes long is a unit's, or stride's own work with many files, which may.
void on_time_limit() {
  const bool is_of_unit = bool(end_note().is_leaving) || importer::is_any_call_unfinished() ||
                          !importer::unfinished_library_work().what.view().empty() ||
                          is_output_locked();
  if (is_of_unit) end_process({.kind = ProcessEnd::Kind::TimeOut});
  begin_time_limit();
}

/// Not SIGALRM, which units use for timers of their own.
int limit_signal() { return SIGRTMAX - 1; }

void on_signal(int signal, siginfo_t* info, void*) {
  if (is_guarded() && is_time_limit(*info)) return on_time_limit();
  if (is_guarded()) end_process({.number = signal, .origin = origin_of(signal, *info)});
  KernelAction().set(signal);  // the default; it comes again when this returns
  ::syscall(SYS_tgkill, ::getpid(), ::gettid(), signal);
}

void handle(int signal, int flags) {
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | flags;
  ::sigaction(signal, &action, nullptr);
}

void handle_by_default(int signal, int flags) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  if (before.sa_handler == SIG_DFL) handle(signal, flags);
}

/// Those of the C library, as another one is handled.
void handle_hidden(int model) {
  struct sigaction handled {};
  ::sigaction(model, nullptr, &handled);
  if (handled.sa_sigaction != on_signal) return;
  const KernelAction action = KernelAction::of(model), none;
  for (int signal = kFirstHidden; signal < SIGRTMIN; ++signal) {
    if (KernelAction::of(signal) == none) action.set(signal);
  }
}

void set_handlers(int flags) {
  for (const int signal : kCrashes) handle_by_default(signal, flags);
  for (const int signal : kEndings) handle_by_default(signal, flags);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) handle_by_default(signal, flags);
  handle_hidden(SIGRTMAX);
}

// ---- exit() and its like ----

void end_by_exit() {
  if (is_guarded()) end_process({.kind = ProcessEnd::Kind::ExitCall});
}

void on_exit_called(int, void*) {
  const bool is_own = core::OwnExit::is_caller_of(__builtin_frame_address(0));
  if (!is_own || !end_note().is_leaving) end_by_exit();
}

/// Before any library of a unit is loaded, so that its exit functions come first; again in a fork,
/// whose own exit functions would come before these.
void register_exit_functions() {
  static pid_t process = 0;
  if (std::exchange(process, ::getpid()) == ::getpid()) return;
  ::on_exit(on_exit_called, nullptr);
  std::at_quick_exit(end_by_exit);
}

void make_time_limit() {
  sigevent notice{};
  notice.sigev_notify = SIGEV_SIGNAL;
  notice.sigev_signo = limit_signal();
  notice.sigev_value.sival_ptr = &guarded;
  guarded.has_time_limit = ::timer_create(CLOCK_MONOTONIC, &notice, &guarded.time_limit) == 0;
}

/// Never destroyed, since destructors of libraries come later.
const CrashGuard::Conclusion& no_conclusion() {
  static const auto& nothing = *new CrashGuard::Conclusion([](const std::string&) {});
  return nothing;
}

}  // namespace

void end_with(const std::string& error) {
  ProcessEnd end{.kind = ProcessEnd::Kind::Error};
  end.text.set(error);
  end_process(end);
}

void end_if_own(int signal, const siginfo_t& info) {
  const SignalOrigin origin = origin_of(signal, info);
  if (origin != SignalOrigin::Outside && is_guarded()) {
    end_process({.number = signal, .origin = origin});
  }
}

CrashGuard::CrashGuard(Conclusion conclusion) : conclusion_(std::move(conclusion)) {
  void* const memory = ::mmap(nullptr, kStackSize, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  const stack_t stack{memory, 0, kStackSize};
  ::sigaltstack(&stack, nullptr);
  set_handlers(SA_ONSTACK);
  register_exit_functions();
  make_time_limit();
  guarded.process = ::getpid();
  guarded.conclusion = &conclusion_;
}

CrashGuard::~CrashGuard() {
  if (guarded.has_time_limit) ::timer_settime(guarded.time_limit, 0, &kNever, nullptr);
  guarded.conclusion = &no_conclusion();
}

void CrashGuard::set_conclusion(Conclusion conclusion) {
  guarded.conclusion = nullptr;
  conclusion_ = std::move(conclusion);
  guarded.conclusion = &conclusion_;
}

void end_guarding() {
  guarded.conclusion = nullptr;
  guarded.process = 0;
}

int leave_with(int code) {
  EndNote& note = end_note();
  if (guarded.ending != 0) wait_for_end();
  note.code = code;
  note.is_leaving.set();
  if (guarded.process != ::getpid()) return code;
  set_handlers(0);
  guarded.conclusion = &no_conclusion();
  limit_end();
  core::OwnExit::begin();
  return code;
}

void limit_end() {
  if (!is_guarded()) return;
  handle(limit_signal(), SA_ONSTACK);
  sigset_t awaited;
  ::sigemptyset(&awaited);
  ::sigaddset(&awaited, limit_signal());
  ::pthread_sigmask(SIG_UNBLOCK, &awaited, nullptr);
  begin_time_limit();
  restore_streams();  // which waits for their locks
}

CrashGuard::Scope::Scope(CrashGuard& guard, Conclusion conclusion)
    : guard_(guard), before_(guard.conclusion_) {
  guard.set_conclusion(std::move(conclusion));
}

CrashGuard::Scope::~Scope() { guard_.set_conclusion(std::move(before_)); }

}  // namespace stride::cli
