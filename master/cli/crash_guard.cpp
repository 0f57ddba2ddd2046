#include "master/cli/crash_guard.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/cli/crash_error.h"
#include "master/importer/fmu_instance.h"
#include "master/util/archive/temporary_folder.h"
#include "master/util/error.h"
#include "master/util/output_file.h"
#include "master/util/readable_text.h"

namespace stride::cli {
namespace {

using core::kCrashes;

constexpr int kRunFailed = 1;
/// Of virtual memory: the conclusion runs on it.
constexpr std::size_t kStackSize = std::size_t{8} << 20;

/// What handlers, which have no arguments, have to know.
struct Guarded {
  std::atomic<const CrashGuard::Conclusion*> conclusion{nullptr};
  std::atomic<pid_t> process{0};
  std::atomic<pid_t> ending{0};         ///< the thread that ends the process
  std::atomic<bool> is_leaving{false};  ///< the command is over
  std::atomic<int> code{0};             ///< of the command
};
Guarded guarded;

[[noreturn]] void end_now(int code) {
  for (;;) ::syscall(SYS_exit_group, code);
}

void print(std::string_view text) { (void)!::write(STDERR_FILENO, text.data(), text.size()); }

/// In the fork.
[[noreturn]] void conclude(int signal, std::span<const importer::UnitCall> calls) {
  try {
    std::array<char, 80> text{};
    const core::Error error = error_of(describe_end(signal, text), calls, guarded.is_leaving);
    print(core::terminal_text(fmt::format("stride: error: {}\n", error.what())));
    (*guarded.conclusion.load())(error.what());
  } catch (...) {  // the rest is lost
  }
  archive::TemporaryFolder::remove_all();
  end_now(kRunFailed);
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

/// Where the fork could not: without the names, which may be damaged.
void print_without_names(int signal) {
  std::array<char, 80> text{};
  print("stride: error: ");
  print(describe_end(signal, text));
  print("; run.json and the report are not complete, the rows up to there are\n");
}

[[noreturn]] void wait_for_end() {
  for (;;) ::pause();
}

/// So that the results do not go on meanwhile. Their handlers call end_process().
void stop_other_threads(pid_t self) {
  constexpr timespec kUntilTheyHaveStopped{0, 2'000'000};
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

[[noreturn]] void end_process(int signal) {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  pid_t ending = 0;
  const pid_t self = ::gettid();
  if (!guarded.ending.compare_exchange_strong(ending, self)) {
    if (ending == self) end_now(kRunFailed);  // what it does to end has ended it
    wait_for_end();
  }
  stop_other_threads(self);
  core::OutputFile::rescue_all();
  std::array<importer::UnitCall, 16> found;
  const std::size_t count = importer::unfinished_calls(found);
  const pid_t fork = ::_Fork();
  if (fork == 0) {
    for (const int other : kCrashes) ::signal(other, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    conclude(signal, std::span(found).first(count));
  }
  if (fork < 0 || !wait_for(fork)) print_without_names(signal);
  end_now(kRunFailed);
}

/// Forks of a guarded process, such as those of hosts, are not guarded.
bool is_guarded() { return guarded.conclusion.load() != nullptr && guarded.process == ::getpid(); }

void on_signal(int signal) {
  if (is_guarded()) end_process(signal);
  ::signal(signal, SIG_DFL);  // it comes again when this returns
  ::raise(signal);
}

/// What takes long is a unit's, or stride's own work with many files, which may.
void on_alarm(int signal) {
  std::array<importer::UnitCall, 1> call;
  const bool is_of_unit = guarded.is_leaving || importer::unfinished_calls(call) > 0 ||
                          importer::unfinished_library_work().library != nullptr;
  if (is_of_unit) return on_signal(signal);
  ::alarm(kLongestEnd);
}

void on_exit() {
  if (is_guarded()) end_process(0);
}

void on_exit_functions() {
  if (!guarded.is_leaving) on_exit();
}

/// The last of the exit functions: the code with which one before it has called exit() does not
/// count.
void keep_code(int code, void*) {
  if (!guarded.is_leaving || guarded.process != ::getpid() || code == guarded.code) return;
  std::fflush(nullptr);
  end_now(guarded.code);
}

/// Before any library of a unit is loaded, so that its exit functions come first.
void register_exit_functions() {
  static const int registered =
      ::on_exit(keep_code, nullptr) + std::atexit(on_exit_functions) + std::at_quick_exit(on_exit);
  (void)registered;
}

void set_handlers(int flags) {
  for (const int signal : kCrashes) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = flags;
    ::sigaction(signal, &action, nullptr);
  }
}

/// Never destroyed, since destructors of libraries come later.
const CrashGuard::Conclusion& no_conclusion() {
  static const auto& nothing = *new CrashGuard::Conclusion([](const std::string&) {});
  return nothing;
}

}  // namespace
}  // namespace stride::cli

// Exported, so that a unit which calls them reaches these.
extern "C" void _exit(int code) {
  stride::cli::on_exit();
  stride::cli::end_now(code);
}
extern "C" void _Exit(int code) noexcept { ::_exit(code); }

namespace stride::cli {

CrashGuard::CrashGuard(Conclusion conclusion) : conclusion_(std::move(conclusion)) {
  void* const memory = ::mmap(nullptr, kStackSize, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  const stack_t stack{memory, 0, kStackSize};
  ::sigaltstack(&stack, nullptr);
  set_handlers(SA_ONSTACK);
  register_exit_functions();
  guarded.process = ::getpid();
  guarded.conclusion = &conclusion_;
}

CrashGuard::~CrashGuard() {
  ::alarm(0);
  guarded.conclusion = &no_conclusion();
}

void CrashGuard::set_conclusion(Conclusion conclusion) {
  guarded.conclusion = nullptr;
  conclusion_ = std::move(conclusion);
  guarded.conclusion = &conclusion_;
}

int leave_with(int code) {
  if (guarded.process != ::getpid()) return code;
  if (guarded.ending != 0) wait_for_end();
  set_handlers(0);
  guarded.code = code;
  guarded.is_leaving = true;
  guarded.conclusion = &no_conclusion();
  limit_end();
  return code;
}

void limit_end() {
  if (!is_guarded()) return;
  std::signal(SIGALRM, on_alarm);
  sigset_t awaited;
  ::sigemptyset(&awaited);
  ::sigaddset(&awaited, SIGALRM);
  ::pthread_sigmask(SIG_UNBLOCK, &awaited, nullptr);
  ::alarm(kLongestEnd);
}

CrashGuard::Scope::Scope(CrashGuard& guard, Conclusion conclusion)
    : guard_(guard), before_(guard.conclusion_) {
  guard.set_conclusion(std::move(conclusion));
}

CrashGuard::Scope::~Scope() { guard_.set_conclusion(std::move(before_)); }

}  // namespace stride::cli
