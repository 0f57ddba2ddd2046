#include "master/loader/network/command_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/outliving_memory.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kChildGlance = 2ms;
constexpr auto kGrace = 500ms;

[[noreturn]] void be_program(std::vector<char*>& arguments, pid_t parent, int in, int out,
                             int err) {
  ::setsid();
  core::OutlivingMemory::leave();
  isolation::reset_signal_handlers();
  isolation::end_with(parent, SIGTERM);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::execvp(arguments.front(), arguments.data());
  const std::string reason =
      fmt::format("cannot run {}: {}\n", arguments.front(), std::strerror(errno));
  isolation::write_all(STDERR_FILENO, reason.data(), reason.size());
  ::_exit(127);
}

void make_nonblocking(int file) {
  const int flags = ::fcntl(file, F_GETFL);
  if (flags < 0 || ::fcntl(file, F_SETFL, flags | O_NONBLOCK) < 0) isolation::fail("fcntl");
}

}  // namespace

CommandProcess::CommandProcess(const std::vector<std::string>& command) : owner_(::getpid()) {
  isolation::Pipe to, from, errors;
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // a pipe's reading end does not wait; that of the program has to
  const int flags = ::fcntl(to.read.number(), F_GETFL);
  ::fcntl(to.read.number(), F_SETFL, flags & ~O_NONBLOCK);
  make_nonblocking(to.write.number());
  make_nonblocking(from.read.number());
  make_nonblocking(errors.read.number());
  process_ = ::fork();
  if (process_ < 0) isolation::fail("fork");
  if (process_ == 0) {
    be_program(arguments, owner_, to.read.number(), from.write.number(), errors.write.number());
  }
  in = std::move(to.write);
  out = std::move(from.read);
  err = std::move(errors.read);
}

CommandProcess::~CommandProcess() { end(0ms); }

bool CommandProcess::has_ended(std::chrono::milliseconds patience) {
  const auto end = Clock::now() + patience;
  while (!status_) {
    int status = 0;
    const pid_t ended = ::waitpid(process_, &status, WNOHANG);
    if (ended == process_) status_ = status;
    if (ended < 0 && errno == ECHILD) status_ = 0;
    if (status_ || Clock::now() >= end) break;
    std::this_thread::sleep_for(kChildGlance);
  }
  return status_.has_value();
}

void CommandProcess::end(std::chrono::milliseconds patience) {
  in.close();
  if (owner_ != ::getpid()) return;
  const bool has_ended_itself = has_ended(patience);
  out.close();
  err.close();
  if (!has_ended_itself) {
    kill(SIGTERM);
    has_ended(kGrace);
  }
  kill(SIGKILL);
  while (!has_ended(kGrace)) {
  }
}

/// The session is a process group of its own, and may have more in it than the program.
void CommandProcess::kill(int signal) const {
  ::kill(-process_, signal);
  if (!status_) ::kill(process_, signal);
}

std::optional<int> CommandProcess::exit_code() const {
  if (!status_ || !WIFEXITED(*status_)) return std::nullopt;
  return WEXITSTATUS(*status_);
}

std::string CommandProcess::how_it_ended() const {
  if (!status_) return "";
  if (const auto code = exit_code()) return fmt::format("ended with the code {}", *code);
  return fmt::format("was ended by {}", isolation::signal_name(WTERMSIG(*status_)));
}

}  // namespace stride::remote
