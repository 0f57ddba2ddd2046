#include "units/process/child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace process {
namespace {

std::string reason(int error) { return std::strerror(error); }

struct Pipe {
  Descriptor read;
  Descriptor write;
};

/// Above the standard descriptors, so that dup2() onto one of them never meets itself.
Descriptor above_standard(int number) {
  if (number > STDERR_FILENO) return Descriptor(number);
  const int moved = ::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::close(number);
  return Descriptor(moved);
}

Pipe make_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error("there is no pipe to the program: " + reason(errno));
  }
  return {above_standard(ends[0]), above_standard(ends[1])};
}

void make_nonblocking(const Descriptor& descriptor) {
  ::fcntl(descriptor.number(), F_SETFL, O_NONBLOCK);
}

bool is_executable(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         ::access(path.c_str(), X_OK) == 0;
}

/// A path as it is; a name as the first executable file of it in PATH.
std::string find_program(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const char* const variable = std::getenv("PATH");
  const std::string folders = variable != nullptr ? variable : "/usr/local/bin:/usr/bin:/bin";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    const std::string path = folders.substr(at, end - at) + "/" + program;
    if (is_executable(path)) return path;
    at = end + 1;
  }
  throw std::runtime_error("cannot start '" + program + "': it is in no folder of PATH (" +
                           folders + "); install it, or name it with its path");
}

/// Whether it is a file that lacks the permission to be executed.
bool is_plain_file(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         (status.st_mode & S_IXUSR) == 0;
}

/// By an executable one of the same content; if that fails it stays.
void replace_by_executable(const std::string& path) {
  const std::string copy = path + "." + std::to_string(::getpid());
  if (!Descriptor(::open(copy.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRWXU)).is_open())
    return;
  std::ofstream file(copy, std::ios::binary);
  file << std::ifstream(path, std::ios::binary).rdbuf();
  file.close();
  if (!file || ::rename(copy.c_str(), path.c_str()) != 0) ::unlink(copy.c_str());
}

/// For a file from an archive without permissions. In a sandbox modes do not change.
void make_executable(const std::string& path) {
  if (is_plain_file(path)) ::chmod(path.c_str(), S_IRWXU);
  if (is_plain_file(path)) replace_by_executable(path);
}

/// What the child does between fork() and exec(): functions that are safe there, and no memory.
class Launch {
 public:
  /// The texts must outlive it.
  Launch(const std::string& path, const std::vector<std::string>& command,
         const std::vector<std::string>& variables)
      : path_(path), words_(pointers(command)), environment_(pointers(variables)) {
    for (char** variable = environ; *variable != nullptr; ++variable) {
      if (!is_replaced(*variable, variables)) environment_.push_back(*variable);
    }
    words_.push_back(nullptr);
    environment_.push_back(nullptr);
  }

  /// Returns errno if it could not be done.
  int run(pid_t parent, const std::array<int, 3>& standard) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);  // it has ended meanwhile
    for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (int i = 0; i < 3; ++i) {
      if (::dup2(standard[static_cast<std::size_t>(i)], i) < 0) return errno;
    }
    ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);  // what others have left open
    ::execve(path_.c_str(), words_.data(), environment_.data());
    return errno;
  }

 private:
  static std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
    return pointers;
  }
  static bool is_replaced(const char* variable, const std::vector<std::string>& by) {
    return std::any_of(by.begin(), by.end(), [&](const std::string& other) {
      return std::strncmp(variable, other.c_str(), other.find('=') + 1) == 0;
    });
  }

  const std::string& path_;
  std::vector<char*> words_;
  std::vector<char*> environment_;
};

/// Empty once the program runs, else why it does not.
int failure_of(const Descriptor& failure) {
  int error = 0;
  ssize_t size = 0;
  do {
    size = ::read(failure.number(), &error, sizeof error);
  } while (size < 0 && errno == EINTR);
  return size == sizeof error ? error : 0;
}

std::string remedy(int error) {
  if (error == ENOENT) return "; it does not exist, or the interpreter in its first line does not";
  if (error == EACCES) return "; make it an executable file (chmod +x)";
  if (error == ENOEXEC) return "; it is not a program for this machine; a script begins with #!";
  return "";
}

}  // namespace

// ---- Descriptor ----

Descriptor::Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this == &other) return *this;
  close();
  number_ = std::exchange(other.number_, -1);
  return *this;
}

void Descriptor::close() {
  if (is_open()) ::close(std::exchange(number_, -1));
}

// ---- Child ----

Child::Child(const std::vector<std::string>& command, const std::vector<std::string>& variables) {
  const std::string path = find_program(command.front());
  make_executable(path);
  Launch launch(path, command, variables);
  Pipe input = make_pipe();
  Pipe output = make_pipe();
  Pipe error = make_pipe();
  Pipe failure = make_pipe();
  const pid_t parent = ::getpid();
  id_ = ::fork();
  if (id_ == 0) {
    const int mistake =
        launch.run(parent, {input.read.number(), output.write.number(), error.write.number()});
    [[maybe_unused]] const auto written = ::write(failure.write.number(), &mistake, sizeof mistake);
    ::_exit(127);
  }
  if (id_ < 0) throw std::runtime_error("cannot start '" + path + "': " + reason(errno));
  ::setpgid(id_, id_);  // here and in the child: either may run first
  failure.write.close();
  if (const int mistake = failure_of(failure.read); mistake != 0) {
    reap(true);
    throw std::runtime_error("cannot start '" + path + "': " + reason(mistake) + remedy(mistake));
  }
  input_ = std::move(input.write);
  output_ = std::move(output.read);
  error_ = std::move(error.read);
  for (const Descriptor* descriptor : {&input_, &output_, &error_}) make_nonblocking(*descriptor);
}

Child::~Child() { kill(); }

bool Child::reap(bool blocks) {
  if (has_ended_) return true;
  const int options = WEXITED | WNOWAIT | (blocks ? 0 : WNOHANG);
  siginfo_t info{};
  int found = 0;
  do {
    found = ::waitid(P_PID, static_cast<id_t>(id_), &info, options);
  } while (found != 0 && errno == EINTR);
  if (found == 0 && info.si_pid == 0) return false;
  ::kill(-id_, SIGKILL);  // what is left of its group, while its number cannot be reused
  if (::waitpid(id_, &status_, 0) != id_) status_ = -1;
  has_ended_ = true;
  return true;
}

bool Child::wait(std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  for (auto pause = std::chrono::microseconds(50); !reap(false); pause *= 2) {
    const auto left = end - std::chrono::steady_clock::now();
    if (left <= std::chrono::seconds(0)) return false;
    std::this_thread::sleep_for(
        std::min<std::chrono::nanoseconds>({pause, left, std::chrono::milliseconds(20)}));
  }
  return true;
}

void Child::kill() {
  if (has_ended_) return;
  ::kill(id_, SIGKILL);
  reap(true);
}

std::string Child::ending() const {
  if (status_ == -1) return "ended";
  if (WIFEXITED(status_)) {
    return "ended with the exit code " + std::to_string(WEXITSTATUS(status_));
  }
  const int signal = WTERMSIG(status_);
  const char* const name = ::sigabbrev_np(signal);
  return "was killed by signal " + std::to_string(signal) +
         (name != nullptr ? std::string(" (SIG") + name + ")" : "");
}

}  // namespace process
