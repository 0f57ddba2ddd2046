#include "master/verify/child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stride::verify {
namespace {

using Clock = std::chrono::steady_clock;
using End = ChildOutcome::End;

constexpr std::size_t kPrintedKept = 4096;
/// How often a child is looked at whose pipes somebody else may hold open.
constexpr std::chrono::milliseconds kGlance{20};

/// What stands before the child's text.
constexpr char kAnswer = 'A';
constexpr char kException = 'E';

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

class File {
 public:
  explicit File(int number = -1) : number_(number) {}
  ~File() { close(); }
  File(File&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() {
    if (is_open()) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

struct Pipe {
  File read, write;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) fail("pipe2");
    read = File(ends[0]);
    write = File(ends[1]);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  }
};

void write_all(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // nobody reads any longer
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// The child's surroundings: a library may have the habits of a program of its own.
void settle(pid_t parent, int output) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGPIPE}) {
    ::signal(signal, SIG_DFL);
  }
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const File empty(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  ::dup2(empty.number(), STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
}

[[noreturn]] void be_child(const std::function<std::string()>& work, int answer) {
  char kind = kAnswer;
  std::string text;
  try {
    text = work();
  } catch (const std::exception& error) {
    kind = kException;
    text = error.what();
  } catch (...) {
    kind = kException;
    text = "something was thrown that is no std::exception";
  }
  write_all(answer, &kind, 1);
  write_all(answer, text.data(), text.size());
  ::_exit(0);
}

/// Reads what there is; at the end of the file it closes it.
void drain(File& file, std::string& text) {
  std::array<char, 65536> buffer;
  while (file.is_open()) {
    const ssize_t size = ::read(file.number(), buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return;
    if (size <= 0) return file.close();
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT | WNOHANG) == 0 &&
         info.si_pid == child;
}

/// Ends all of the child's group and takes the child's status away.
int reap(pid_t child) {
  ::kill(-child, SIGKILL);
  ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

class Watch {
 public:
  Watch(pid_t child, File answer, File output, const ChildOptions& options)
      : child_(child),
        answer_(std::move(answer)),
        output_(std::move(output)),
        options_(options),
        begin_(Clock::now()) {}

  ChildOutcome run() {
    std::optional<End> cut_off;
    while (!has_ended(child_) && !cut_off) {
      wait();
      read();
      cut_off = reason_to_stop();
    }
    const int status = reap(child_);
    read();
    ChildOutcome outcome = cut_off ? ChildOutcome{*cut_off, 0, {}, {}} : judge(status);
    outcome.printed = std::move(printed_);
    return outcome;
  }

 private:
  void wait() const {
    std::array<pollfd, 2> files{{{answer_.number(), POLLIN, 0}, {output_.number(), POLLIN, 0}}};
    const bool is_over = !answer_.is_open() && !output_.is_open();
    // when its pipes are closed it is about to end
    ::poll(files.data(), files.size(), is_over ? 1 : static_cast<int>(kGlance.count()));
  }

  void read() {
    drain(answer_, text_);
    drain(output_, printed_);
    if (printed_.size() > kPrintedKept) printed_.erase(0, printed_.size() - kPrintedKept);
  }

  std::optional<End> reason_to_stop() const {
    if (options_.interrupted != nullptr && *options_.interrupted != 0) return End::Interrupted;
    if (options_.limit && Clock::now() - begin_ > *options_.limit) return End::TimedOut;
    return std::nullopt;
  }

  ChildOutcome judge(int status) {
    if (WIFSIGNALED(status)) return {End::Killed, WTERMSIG(status), {}, {}};
    if (WEXITSTATUS(status) != 0 || text_.empty()) {
      return {End::Exited, WEXITSTATUS(status), {}, {}};
    }
    const End end = text_.front() == kAnswer ? End::Answered : End::Threw;
    return {end, 0, text_.substr(1), {}};
  }

  pid_t child_;
  File answer_, output_;
  const ChildOptions& options_;
  Clock::time_point begin_;
  std::string text_, printed_;
};

}  // namespace

ChildOutcome run_in_child(const std::function<std::string()>& work, const ChildOptions& options) {
  Pipe answer;
  Pipe output;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    settle(parent, output.write.number());
    be_child(work, answer.write.number());
  }
  ::setpgid(child, child);  // whoever of the two comes first
  answer.write.close();
  output.write.close();
  return Watch(child, std::move(answer.read), std::move(output.read), options).run();
}

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name != nullptr ? std::string("SIG") + name : "an unknown signal";
}

SharedNote::SharedNote() {
  void* const memory =
      ::mmap(nullptr, sizeof(Memory), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail("mmap");
  memory_ = static_cast<Memory*>(memory);
}

SharedNote::~SharedNote() { ::munmap(memory_, sizeof(Memory)); }

void SharedNote::write(const char* what, std::int64_t picoseconds) {
  memory_->picoseconds = picoseconds;
  const std::size_t size = std::min(std::strlen(what), sizeof memory_->what - 1);
  std::memcpy(memory_->what, what, size);
  memory_->what[size] = '\0';
}

std::string SharedNote::what() const {
  return {memory_->what, ::strnlen(memory_->what, sizeof memory_->what)};
}

}  // namespace stride::verify
