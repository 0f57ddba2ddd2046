#include "tests/test_units/faults/faults.h"

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stride/results.h>

#include "tests/test_units/faults/memory_faults.h"
#include "tests/test_units/faults/process_faults.h"

namespace stride::tests {
namespace {

void write_to_nowhere() {
  int* volatile nowhere = reinterpret_cast<int*>(16);
  *nowhere = 1;
}

void abort_aloud() {
  std::fputs("the model is inconsistent\n", stderr);
  std::abort();
}

void exit_in_thread() {
  std::thread([] { std::exit(5); }).join();
}

void throw_in_thread() {
  std::thread([] { throw std::runtime_error("nobody catches this"); }).join();
}

/// Deeper than any stack; the frames are looked at, so none is left out.
int recurse(int depth, volatile char* above) {
  volatile char frame[4096];
  frame[0] = *above;
  return depth == 0 ? 0 : recurse(depth - 1, frame) + frame[0];
}

void overflow_the_stack() {
  volatile char first = 0;
  recurse(1 << 30, &first);
}

[[noreturn]] void loop() {
  for (volatile unsigned i = 0;; i = i + 1) {
  }
}

/// Says so by a file, and goes on as if nothing was.
void doze() {
  if (const char* const results = std::getenv("STRIDE_RESULTS")) {
    std::ofstream(std::string(results) + "/dozes") << "now";
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
}

/// A megabyte, and goes on as if nothing was.
void print() {
  for (int i = 0; i < 16384; ++i) std::printf("line %5d: %s\n", i, std::string(50, '.').c_str());
  std::fflush(stdout);
}

/// It goes on in the unit's code, also when that has been unloaded.
void leave_thread() {
  std::thread([] {
    for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }).detach();
}

/// Where no handler of a signal hears of it.
void leave_deaf_thread() {
  std::thread([] {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
    for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }).detach();
}

/// It ends soon, by itself.
void leave_short_thread() {
  std::thread([] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }).detach();
}

/// In a thread, until the process ends.
void keep_lock_of(std::FILE* stream) {
  static std::atomic<bool> is_locked{false};
  std::thread([stream] {
    ::flockfile(stream);
    is_locked = true;
    sleep_for_ever();
  }).detach();
  while (!is_locked) std::this_thread::yield();
}

void say_end(int, void*) { std::fputs("the function of on_exit() runs\n", stderr); }

/// Another file takes the number of each one but the standard ones.
void replace_all_files() {
  const int nothing = ::open("/dev/null", O_RDWR);
  for (int file = 3; file < 256; ++file) {
    if (file != nothing) ::dup2(nothing, file);
  }
}

void move_in_all_files() {
  for (int file = 3; file < 256; ++file) ::lseek(file, 0, SEEK_SET);
}

void cut_all_files() {
  for (int file = 3; file < 256; ++file) static_cast<void>(!::ftruncate(file, 0));
}

void close_all_files() {
  for (int file = 0; file < 1024; ++file) ::close(file);
}

/// In a thread, again and again.
void keep_closing_files() {
  static std::atomic<bool> has_begun{false};
  std::thread([] {
    for (;; has_begun = true, std::this_thread::sleep_for(std::chrono::microseconds(500))) {
      for (int file = 3; file < 100; ++file) ::close(file);
    }
  }).detach();
  while (!has_begun) std::this_thread::yield();
}

void kill_parent() {
  if (::kill(::getppid(), SIGKILL) != 0) fail("cannot kill the parent");
}

/// Leaves its group and its parent, as a service does.
void start_daemon() {
  if (::fork() == 0) {
    ::setsid();
    if (::fork() == 0) sleep_for_ever();
    ::_exit(0);
  }
}

/// Another process goes on printing what it has begun.
void die_while_another_prints() {
  if (::fork() == 0) {
    for (;;) print();
  }
  write_to_nowhere();
}

/// What it shares with other processes, whatever that is.
template <class Visit>
void for_each_shared_memory(Visit&& visit) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long begin = 0, end = 0;
    char mode[5] = "";
    if (std::sscanf(line.c_str(), "%lx-%lx %4s", &begin, &end, mode) != 3) continue;
    if (std::string(mode) == "rw-s") visit(reinterpret_cast<void*>(begin), end - begin);
  }
}

void overwrite_shared_memory() {
  for_each_shared_memory([](void* begin, std::size_t size) { std::memset(begin, 0xee, size); });
}

void unmap_shared_memory() {
  for_each_shared_memory([](void* begin, std::size_t size) { ::munmap(begin, size); });
}

void protect_shared_memory() {
  for_each_shared_memory([](void* begin, std::size_t size) { ::mprotect(begin, size, PROT_READ); });
}

void write_temporary() {
  std::string name = std::string(std::getenv("TMPDIR")) + "/notes-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) fail("cannot make " + name);
  ::close(file);
}

void connect() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  if (socket < 0) fail("cannot make a socket");
  ::close(socket);
}

/// Does not go on where the signal does not end the process.
template <int signal>
void raise_signal() {
  std::raise(signal);
}

void block_signals() {
  sigset_t all;
  ::sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, nullptr);
}

void limit_resources() {
  const rlimit few{8, 8};
  ::setrlimit(RLIMIT_NOFILE, &few);
  const rlimit short_files{64, 64};
  ::setrlimit(RLIMIT_FSIZE, &short_files);
}

/// No file can be opened from then on.
void limit_open_files() {
  const rlimit none{3, 3};
  if (::setrlimit(RLIMIT_NOFILE, &none) != 0) fail("cannot limit the open files");
  if (::prlimit(0, RLIMIT_NOFILE, &none, nullptr) != 0) fail("cannot limit the open files");
}

/// As a unit does in the end that forgets to close them.
void open_all_files() {
  while (::open("/dev/null", O_RDONLY) >= 0) {
  }
}

void limit_parent() {
  const rlimit none{0, 0};
  if (::prlimit(::getppid(), RLIMIT_CPU, &none, nullptr) != 0) fail("cannot limit the parent");
}

/// Denormal numbers become 0, as in a library that is linked with -ffast-math.
void flush_to_zero() {
#ifdef __SSE2__
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x40;
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | kFlushToZero | kDenormalsAreZero);
#endif
}

/// String instructions run backward.
void set_direction_flag() {
#ifdef __x86_64__
  asm volatile("std");
#endif
}

void use_terminal() {
  const int terminal = ::open("/dev/tty", O_RDWR);
  if (terminal < 0) fail("there is no terminal");
  ::close(terminal);
}

/// By a system call, which is not replaced, unlike setrlimit().
void limit_by_system_call(int resource) {
  const rlimit none{0, 0};
  if (::syscall(SYS_prlimit64, 0, resource, &none, nullptr) != 0) fail("cannot limit a resource");
}

/// As a log file of the unit's own would be.
void divert_errors() {
  const int file = ::open("/dev/null", O_WRONLY);
  ::dup2(file, STDERR_FILENO);
}

void write_over_run_file() { std::ofstream("out/run.json") << "[1, 2"; }

void close_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
}

/// In a buffer that goes with the library.
void buffer_output() {
  static char buffer[BUFSIZ];
  std::setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
  std::fputs("buffered", stdout);
}

/// Where the unit's files belong.
std::string own_file(const char* name) { return stride::results_folder() / name; }

void plant_link() {
  if (::symlink("/etc/passwd", own_file("signals.csv").c_str()) != 0) fail("cannot make a link");
}

void plant_fifo() {
  if (::mkfifo(own_file("signals.csv").c_str(), 0600) != 0) fail("cannot make a FIFO");
}

/// The first process goes on when the other one is gone.
void fork_and_return() {
  const pid_t other = ::fork();
  if (other > 0) ::waitpid(other, nullptr, 0);
}

struct Fault {
  const char* name;
  void (*commit)();
};

/// Without a destructor: some faults come when libraries are unloaded.
constexpr Fault kFaults[] = {
    {"segfault", write_to_nowhere},
    {"abort", abort_aloud},
    {"exit", [] { std::exit(3); }},
    {"exit with 0", [] { std::exit(0); }},
    {"_exit", [] { ::_exit(4); }},
    {"exit in a thread", exit_in_thread},
    {"throw in a thread", throw_in_thread},
    {"stack overflow", overflow_the_stack},
    {"loop", loop},
    {"sleep", sleep_for_ever},
    {"stop", [] { std::raise(SIGSTOP); }},
    {"kill", [] { std::raise(SIGKILL); }},
    {"kill parent", kill_parent},
    {"allocate", allocate},
    {"print", print},
    {"print for ever",
     [] {
       for (;;) print();
     }},
    {"close files", close_all_files},
    {"keep closing files", keep_closing_files},
    {"replace files", replace_all_files},
    {"move in files", move_in_all_files},
    {"cut files", cut_all_files},
    {"leave thread", leave_thread},
    {"leave deaf thread", leave_deaf_thread},
    {"leave short thread", leave_short_thread},
    {"leave handler", [] { std::signal(SIGPROF, [](int) {}); }},
    {"keep lock of output", [] { keep_lock_of(stdout); }},
    {"keep lock of errors", [] { keep_lock_of(stderr); }},
    {"on_exit", [] { ::on_exit(say_end, nullptr); }},
    {"daemon", start_daemon},
    {"die while another prints", die_while_another_prints},
    {"doze", doze},
    {"allocate shared", allocate_shared},
    {"allocate in children", allocate_in_children},
    {"write nameless file", write_nameless_file},
    {"write temporary file", write_temporary_file},
    {"overwrite", overwrite_shared_memory},
    {"unmap shared memory", unmap_shared_memory},
    {"protect shared memory", protect_shared_memory},
    {"overwrite and abort",
     [] {
       overwrite_shared_memory();
       std::abort();
     }},
    {"overwrite and die",
     [] {
       overwrite_shared_memory();
       std::raise(SIGKILL);
     }},
    {"connect", connect},
    {"write temporary", write_temporary},
    {"SIGFPE", raise_signal<SIGFPE>},
    {"SIGILL", raise_signal<SIGILL>},
    {"SIGBUS", raise_signal<SIGBUS>},
    {"SIGSYS", raise_signal<SIGSYS>},
    {"SIGTERM", raise_signal<SIGTERM>},
    {"SIGINT", raise_signal<SIGINT>},
    {"SIGUSR1", raise_signal<SIGUSR1>},
    {"SIGQUIT", raise_signal<SIGQUIT>},
    {"SIGPROF", raise_signal<SIGPROF>},
    {"SIGXCPU", raise_signal<SIGXCPU>},
    {"SIGRTMIN+3", [] { std::raise(SIGRTMIN + 3); }},
    {"hidden signal", raise_hidden_signal},
    {"alarm", await_alarm},
    {"own alarms", leave_alarms},
    {"exec", become_program},
    {"exec by system call", become_program_by_system_call},
    {"become daemon", become_daemon},
    {"exit by system call", exit_by_system_call},
    {"exit of a looked-up name", exit_of_looked_up_name},
    {"default signal", raise_default_signal},
    {"exit by system call at exit", exit_by_system_call_at_exit},
    {"run programs", run_programs},
    {"fork by system call", fork_by_system_call},
    {"damage free memory", damage_free_memory},
    {"lock memory", lock_memory},
    {"throw int", [] { throw 42; }},
    {"throw bad_alloc", [] { throw std::bad_alloc(); }},
    {"throw exception", [] { throw std::runtime_error("the fuse has blown"); }},
    {"change folder",
     [] {
       if (::chdir("/") != 0) fail("cannot change the folder");
     }},
    {"change umask", [] { ::umask(0777); }},
    {"block signals", block_signals},
    {"ignore SIGINT", [] { std::signal(SIGINT, SIG_IGN); }},
    {"limit resources", limit_resources},
    {"limit open files", limit_open_files},
    {"limit memory by system call", [] { limit_by_system_call(RLIMIT_DATA); }},
    {"limit files by system call", [] { limit_by_system_call(RLIMIT_FSIZE); }},
    {"open all files", open_all_files},
    {"open all files and crash",
     [] {
       open_all_files();
       write_to_nowhere();
     }},
    {"cancel thread", [] { ::pthread_cancel(::pthread_self()); }},
    {"fork", fork_and_return},
    {"fork and go on", [] { static_cast<void>(::fork()); }},
    {"send nameless files", send_nameless_files},
    {"limit parent", limit_parent},
    {"round up", [] { std::fesetround(FE_UPWARD); }},
    {"flush to zero", flush_to_zero},
    {"set direction flag", set_direction_flag},
    {"close streams", close_streams},
    {"close streams and crash",
     [] {
       close_streams();
       write_to_nowhere();
     }},
    {"divert errors and crash",
     [] {
       divert_errors();
       write_to_nowhere();
     }},
    {"write over run file and die",
     [] {
       write_over_run_file();
       std::raise(SIGKILL);
     }},
    {"remove run file and die",
     [] {
       ::unlink("out/run.json");
       std::raise(SIGKILL);
     }},
    {"be traced and crash",
     [] {
       ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
       write_to_nowhere();
     }},
    {"crash at exit", [] { ::on_exit([](int, void*) { write_to_nowhere(); }, nullptr); }},
    {"exit at exit", [] { ::on_exit([](int, void*) { std::exit(0); }, nullptr); }},
    {"buffer output", buffer_output},
    {"drop output stream", [] { stdout = nullptr; }},
    {"use terminal", use_terminal},
    {"link", plant_link},
    {"FIFO", plant_fifo},
};

const char* setting(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string fault_names() {
  std::string names;
  for (const Fault& fault : kFaults) names += (names.empty() ? "" : ", ") + std::string(fault.name);
  return names;
}

void commit_fault(const std::string& name) {
  std::fprintf(stderr, "now comes: %s\n", name.c_str());
  const auto named = [&](const Fault& fault) { return fault.name == name; };
  const auto fault = std::find_if(std::begin(kFaults), std::end(kFaults), named);
  if (fault == std::end(kFaults)) throw std::out_of_range("there is no fault '" + name + "'");
  fault->commit();
}

}  // namespace stride::tests

extern "C" int stride_test_fault(const char* call, double time) {
  using stride::tests::setting;
  static bool has_acted = false;
  const std::string fault = setting("STRIDE_TEST_FAULT");
  const bool is_due = !fault.empty() && std::strcmp(call, setting("STRIDE_TEST_CALL")) == 0 &&
                      time >= std::atof(setting("STRIDE_TEST_AT"));
  if (!is_due || has_acted) return 0;
  has_acted = true;
  int status = 0;
  if (std::sscanf(fault.c_str(), "status %d", &status) != 1) stride::tests::commit_fault(fault);
  return status;
}

namespace {

/// When the library goes.
struct Unloading {
  ~Unloading() { stride_test_fault("unload", HUGE_VAL); }
} unloading;

}  // namespace
