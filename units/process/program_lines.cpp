#include "units/process/program_lines.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include <stride/process/value.h>

namespace process {
namespace {

constexpr std::size_t kRead = std::size_t{1} << 16;  // what a pipe holds
constexpr std::size_t kErrorLines = 10;
constexpr std::size_t kErrorLine = 1000;
constexpr std::size_t kQuoted = 200;
constexpr std::chrono::milliseconds kEnding{2000};

/// A write to a program that has ended would end this process by SIGPIPE. The mask is that of this
/// thread; a signal that has come meanwhile is taken away.
ssize_t write_without_signal(int descriptor, const char* data, std::size_t size) {
  sigset_t pipe, before;
  ::sigemptyset(&pipe);
  ::sigaddset(&pipe, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &pipe, &before);
  const ssize_t written = ::write(descriptor, data, size);
  const int error = errno;
  if (written < 0 && error == EPIPE && ::sigismember(&before, SIGPIPE) == 0) {
    const timespec now{};
    ::sigtimedwait(&pipe, nullptr, &now);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return written;
}

/// A program may write any bytes; in messages and in the log they are text.
std::string printable(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t unfit = std::min(stride::process::first_unfit(text), text.size());
    result.append(text.substr(0, unfit));
    if (unfit == text.size()) return result;
    result += "\uFFFD";
    text.remove_prefix(unfit + 1);
  }
}

std::string cited(std::string_view text) {
  const bool is_long = text.size() > kQuoted;
  return "'" + printable(text.substr(0, kQuoted)) + (is_long ? "…'" : "'");
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t\r"), text.size());
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

}  // namespace

ProgramLines::ProgramLines(const std::vector<std::string>& command, const Limits& limits,
                           Listener listener, const std::vector<std::string>& variables)
    : name_(std::filesystem::path(command.front()).filename().string()),
      limits_(limits),
      listener_(std::move(listener)),
      child_(std::make_unique<Child>(command, variables)),
      buffer_(2 * kRead) {
  if (command.size() > 1) {
    name_ += " " + std::filesystem::path(command[1]).filename().string();
  }
}

// ---- Writing ----

void ProgramLines::send(std::string_view awaited) {
  awaited_.assign(awaited);
  answered_ = 0;
  heard_ = Clock::now();
  written_ = 0;
  while (!write_some()) exchange();
  commands_.clear();
  written_ = 0;
}

/// Returns whether all has been written.
bool ProgramLines::write_some() {
  while (written_ < commands_.size()) {
    const ssize_t size = write_without_signal(child_->input().number(), commands_.data() + written_,
                                              commands_.size() - written_);
    if (size >= 0) {
      written_ += static_cast<std::size_t>(size);
    } else if (errno == EAGAIN) {
      return false;
    } else if (errno != EINTR) {
      // what it wrote before it closed its input may explain why
      return true;
    }
  }
  return true;
}

// ---- Reading ----

std::string_view ProgramLines::next_line() {
  while (true) {
    while (!take_line(line_)) exchange();
    ++line_number_;
    line_ = without_blanks(line_);
    if (!line_.empty()) return line_;
  }
}

bool ProgramLines::take_line(std::string_view& line) {
  const char* const text = buffer_.data();
  const void* const feed = std::memchr(text + seen_, '\n', end_ - seen_);
  if (feed == nullptr) {
    seen_ = end_;
    return false;
  }
  const auto at = static_cast<std::size_t>(static_cast<const char*>(feed) - text);
  line = {text + begin_, at - begin_};
  begin_ = seen_ = at + 1;
  return true;
}

/// Waits until the program writes something, or takes what is written to it.
void ProgramLines::exchange() {
  const bool is_writing = written_ < commands_.size();
  pollfd waiting[3] = {{child_->output().number(), POLLIN, 0},
                       {child_->error().number(), POLLIN, 0},
                       {is_writing ? child_->input().number() : -1, POLLOUT, 0}};
  const int ready = ::poll(waiting, 3, poll_timeout());
  if (ready < 0 && errno != EINTR) {
    fail(std::string("its pipes cannot be waited for: ") + std::strerror(errno));
  }
  if (ready == 0) {
    wait_for_end({});
    fail("wrote nothing for " + std::to_string(limits_.silence.count()) + " ms while it was to " +
         awaited_ +
         ", and was ended; if that is what it needs, raise the parameter process.time_limit");
  }
  if (ready < 0) return;
  if (waiting[1].revents != 0) read_error();
  if (waiting[0].revents != 0) read_output();
}

int ProgramLines::poll_timeout() const {
  if (limits_.silence.count() == 0) return -1;
  const auto left = heard_ + limits_.silence - Clock::now();
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(left).count();
  return static_cast<int>(std::clamp<std::int64_t>(milliseconds + 1, 0, 1'000'000'000));
}

void ProgramLines::make_room() {
  if (begin_ == end_) {
    begin_ = seen_ = end_ = 0;
  } else if (buffer_.size() - end_ < kRead && begin_ != 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    seen_ -= begin_;
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() - end_ < kRead) buffer_.resize(2 * buffer_.size());
}

void ProgramLines::read_output() {
  if (read_some() == 0) fail_at_end();
}

/// Returns what read() does.
ssize_t ProgramLines::read_some() {
  make_room();
  const ssize_t size =
      ::read(child_->output().number(), buffer_.data() + end_, buffer_.size() - end_);
  if (size <= 0) return size;
  heard_ = Clock::now();
  end_ += static_cast<std::size_t>(size);
  count(static_cast<std::size_t>(size));
  return size;
}

void ProgramLines::count(std::size_t bytes) {
  answered_ += bytes;
  if (answered_ <= limits_.answer) return;
  child_->kill();
  fail("has written more than " + std::to_string(limits_.answer) + " bytes while it was to " +
       awaited_ +
       ", without a <sync/>, and was ended; it may have the parameter "
       "process.answer_limit for more. It wrote last: " +
       cited({buffer_.data() + begin_, end_ - begin_}));
}

/// Returns whether there may be more.
bool ProgramLines::read_error() {
  char text[4096];
  const ssize_t size = ::read(child_->error().number(), text, sizeof text);
  if (size == 0) child_->error().close();
  if (size <= 0) return size < 0 && errno == EINTR;
  hear({text, static_cast<std::size_t>(size)});
  count(static_cast<std::size_t>(size));
  return true;
}

void ProgramLines::hear(std::string_view text) {
  for (const char c : text) {
    if (c != '\n') error_line_ += c;
    if (c == '\n' || error_line_.size() == kErrorLine) {
      note_error(printable(std::exchange(error_line_, {})));
    }
  }
}

void ProgramLines::note_error(std::string line) {
  if (listener_) listener_(line);
  last_errors_.push_back(std::move(line));
  if (last_errors_.size() > kErrorLines) last_errors_.pop_front();
}

// ---- Ends ----

void ProgramLines::finish() {
  awaited_ = "end";
  answered_ = 0;
  heard_ = Clock::now();
  if (!write_some()) {
    fail("does not read that it is to end");
  }
  child_->input().close();
  const auto limit = limits_.silence.count() != 0 ? limits_.silence : std::chrono::hours(24 * 365);
  if (!wait_for_end(limit)) {
    fail("received the end command, and has not ended within " +
         std::to_string(limits_.silence.count()) +
         " ms; it should end after <end/>, or where its standard input ends");
  }
}

std::optional<std::string_view> ProgramLines::next_last_line() {
  while (take_line(line_)) {
    ++line_number_;
    line_ = without_blanks(line_);
    if (!line_.empty()) return line_;
  }
  return std::nullopt;
}

void ProgramLines::require_success() const {
  if (child_->has_succeeded()) return;
  fail(child_->ending() + " at the end of the run; expected the exit code 0");
}

/// Returns whether the program has ended by itself within the limit; else it is killed.
bool ProgramLines::wait_for_end(std::chrono::milliseconds limit) {
  constexpr std::chrono::milliseconds kSlice{10};
  const auto end = Clock::now() + limit;
  bool has_ended = child_->wait({});
  while (!has_ended && Clock::now() < end) {
    has_ended = child_->wait(kSlice);
    read_rest();  // so that the program is not blocked by a full pipe
  }
  child_->kill();
  read_rest();
  return has_ended;
}

/// All that is there, of both outputs.
void ProgramLines::read_rest() {
  while (read_error()) {
  }
  while (read_some() > 0) {
  }
}

void ProgramLines::fail_at_end() {
  const bool has_ended = wait_for_end(kEnding);
  const std::string rest(buffer_.data() + begin_, end_ - begin_);
  const std::string torn = rest.empty() ? "" : "; its last line is cut off: " + cited(rest);
  if (has_ended) fail(child_->ending() + " while it was to " + awaited_ + torn);
  fail("has closed its standard output while it was to " + awaited_ + torn);
}

void ProgramLines::fail_line(const std::string& message) const {
  fail("wrote as line " + std::to_string(line_number_) + " " + cited(line_) + ": " + message);
}

void ProgramLines::fail(const std::string& message) const {
  std::string text = "the program '" + name_ + "' " + message;
  std::deque<std::string> lines = last_errors_;
  if (!error_line_.empty()) lines.push_back(printable(error_line_));
  if (!lines.empty()) text += "\n  its last lines on standard error:";
  for (const std::string& line : lines) text += "\n    " + line;
  throw std::runtime_error(text);
}

}  // namespace process
