#include "tests/cli/program.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/build.h"

namespace stride::tests {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A file without a name takes whatever is written, so no reader has to keep up.
int nameless_file() {
  const int file = ::memfd_create("output", MFD_CLOEXEC);
  if (file < 0) fail("memfd_create");
  return file;
}

std::string content_of(int file) {
  std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
  if (::pread(file, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    fail("pread");
  }
  return text;
}

[[noreturn]] void become(char* const* arguments, const char* folder, int out, int err) {
  constexpr int kCannotStart = 127;
  ::signal(SIGINT, SIG_DFL);  // a shell's background jobs inherit that it is ignored
  const bool is_ready = (*folder == '\0' || ::chdir(folder) == 0) &&
                        ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0;
  if (is_ready) ::execvp(arguments[0], arguments);
  ::_exit(kCannotStart);
}

}  // namespace

Process::Process(const Arguments& arguments, const std::filesystem::path& folder)
    : out_(nameless_file()), err_(nameless_file()) {
  std::vector<char*> words;
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  id_ = ::fork();
  if (id_ < 0) fail("fork");
  if (id_ == 0) become(words.data(), folder.c_str(), out_, err_);
}

Process::~Process() {
  if (!has_ended_) {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  ::close(out_);
  ::close(err_);
}

bool Process::is_running() {
  if (!has_ended_) has_ended_ = ::waitpid(id_, &status_, WNOHANG) == id_;
  return !has_ended_;
}

void Process::send(int signal) const {
  if (::kill(id_, signal) != 0) fail("kill");
}

Outcome Process::wait() {
  while (!has_ended_) {
    has_ended_ = ::waitpid(id_, &status_, 0) == id_;
    if (!has_ended_ && errno != EINTR) fail("waitpid");
  }
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  return {code, content_of(out_), content_of(err_)};
}

Arguments stride_command(Arguments arguments) {
  ::setenv("STRIDE_UNITS", (test_unit_folder().string() + ":" + unit_folder().string()).c_str(), 1);
  arguments.insert(arguments.begin(), stride_program());
  return arguments;
}

Outcome run_program(const Arguments& arguments, const std::filesystem::path& folder) {
  return Process(stride_command(arguments), folder).wait();
}

}  // namespace stride::tests
