#include "tests/test_units/faults/process_faults.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <dlfcn.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/test_units/faults/memory_faults.h"

namespace stride::tests {
namespace {

constexpr const char* kProgram = "/bin/true";

void require_good(int status, const char* how) {
  if (status != 0) throw std::runtime_error(std::string("no program was run by ") + how);
}

void require_good_end(pid_t process, const char* how) {
  int status = -1;
  ::waitpid(process, &status, 0);
  require_good(status, how);
}

}  // namespace

void become_program() { ::execlp("sleep", "sleep", "30", nullptr); }

void become_program_by_system_call() {
  std::array<const char*, 2> words{"true", nullptr};
  ::syscall(SYS_execve, kProgram, words.data(), environ);
}

void become_daemon() {
  if (::daemon(1, 1) != 0) fail("cannot become a daemon");
}

void exit_by_system_call() { ::syscall(SYS_exit_group, 0); }

void exit_of_looked_up_name() {
  void* const library = ::dlopen("libc.so.6", RTLD_LAZY);
  reinterpret_cast<void (*)(int)>(::dlsym(library, "_exit"))(0);
}

void raise_default_signal() {
  ::signal(SIGSEGV, SIG_DFL);
  ::raise(SIGSEGV);
}

void exit_by_system_call_at_exit() {
  ::on_exit([](int, void*) { exit_by_system_call(); }, nullptr);
}

void run_programs() {
  require_good(std::system("true"), "system()");
  std::FILE* const pipe = ::popen("true", "r");
  require_good(pipe == nullptr ? -1 : ::pclose(pipe), "popen()");
  std::array<char*, 2> words{const_cast<char*>("true"), nullptr};
  pid_t spawned = 0;
  require_good(::posix_spawn(&spawned, kProgram, nullptr, nullptr, words.data(), environ),
               "posix_spawn()");
  require_good_end(spawned, "posix_spawn()");
  const pid_t copy = ::fork();
  if (copy == 0) {
    ::execlp("true", "true", nullptr);
    ::_exit(1);
  }
  require_good_end(copy, "fork() and execlp()");
  const pid_t sharing = ::vfork();
  if (sharing == 0) {
    ::execle(kProgram, "true", nullptr, environ);
    ::_exit(1);
  }
  require_good_end(sharing, "vfork() and execle()");
}

void fork_by_system_call() {
  const long other = ::syscall(SYS_clone, SIGCHLD, nullptr, nullptr, nullptr, nullptr);
  if (other > 0) ::waitpid(static_cast<pid_t>(other), nullptr, 0);
}

void await_alarm() {
  const itimerval soon{{}, {0, 1000}};
  ::setitimer(ITIMER_REAL, &soon, nullptr);
  sleep_for_ever();
}

/// A timer of the unit's own, which runs on when the unit is gone.
void leave_alarms() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGALRM, &action, nullptr);
  const itimerval each{{0, 1000}, {0, 1000}};
  ::setitimer(ITIMER_REAL, &each, nullptr);
}

void raise_hidden_signal() { ::syscall(SYS_tgkill, ::getpid(), ::gettid(), SIGRTMIN - 1); }

}  // namespace stride::tests
