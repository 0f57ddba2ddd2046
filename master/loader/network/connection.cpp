#include "master/loader/network/connection.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include "master/base/text/readable_text.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;

constexpr auto kGlance = 50ms;
/// For the other side, to end its unit, and to send what it still says.
constexpr auto kEndPatience = 5s;
constexpr auto kLastWordsPatience = 500ms;
constexpr auto kInterruptedPatience = 1s;
constexpr std::size_t kMostLines = 8;
constexpr std::size_t kLongestLine = 300;
constexpr std::size_t kMostErrText = 4096;
/// What was sent goes away when it is above this [byte].
constexpr std::size_t kKept = std::size_t{1} << 22;

/// As write(); a pipe that nobody reads is EPIPE, and no signal.
ssize_t write_without_signal(int file, const char* bytes, std::size_t size) {
  sigset_t broken, before;
  ::sigemptyset(&broken);
  ::sigaddset(&broken, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &broken, &before);
  const ssize_t written = ::write(file, bytes, size);
  const int reason = errno;
  if (written < 0 && reason == EPIPE) {
    constexpr timespec kNow{};
    ::sigtimedwait(&broken, nullptr, &kNow);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = reason;
  return written;
}

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

Connection::Connection(ConnectionOptions options) : options_(std::move(options)) {
  statistics_.machine = options_.place.machine;
  try {
    process_.emplace(options_.place.command);
  } catch (const std::system_error& reason) {
    throw core::EnvironmentError(options_.context,
                                 fmt::format("no program can be started: {}", reason.what()));
  }
  pending_ = greeting_line(Side::Master, own_greeting());
  heard_ = Clock::now();
}

Connection::~Connection() {
  if (!process_) return;
  process_->in.close();
  const auto end = Clock::now() + (has_failed() ? 0ms : std::chrono::milliseconds(kEndPatience));
  try {  // it may wait for its last words to be read
    while (process_->out.is_open() && Clock::now() < end) pump(kGlance);
  } catch (const std::exception&) {
  }
  process_->end(has_failed() ? 0ms : std::chrono::milliseconds(kGlance));
}

// ---- Messages ----

void Connection::require_link() const {
  if (!has_failed()) return;
  core::fail_run(options_.context, "it cannot be called, because " + failure_);
}

void Connection::greet() {
  call_ = "the connection";
  while (!greeting_) {
    if (!pump(kGlance) && !process_->out.is_open()) fail_end();
    check_silence(options_.connect_limit);
    check_interruption();
  }
  heard_ = Clock::now();
}

PacketWriter Connection::write() {
  require_link();
  packet_.trim();
  return PacketWriter(packet_);
}

void Connection::append(RequestCode request, bool is_awaited, const PacketWriter& packet) {
  require_link();
  append_message(pending_, RequestHead{request, is_awaited}, packet.bytes());
}

void Connection::put(RequestCode request, const PacketWriter& packet) {
  append(request, false, packet);
}

void Connection::send(RequestCode request, const PacketWriter& packet, const char* call) {
  append(request, true, packet);
  call_ = call;
  heard_ = Clock::now();
  statistics_.round_trips += 1;
  write_pending();
}

Message<ReplyHead> Connection::receive() {
  for (;;) {
    if (const auto reply = receive(options_.silence_limit)) return *reply;
  }
}

/// What has come already counts, however long nobody has looked; and who never stops to talk can be
/// interrupted, too.
std::optional<Message<ReplyHead>> Connection::receive(std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  for (;;) {
    check_interruption();
    if (const auto reply = next_reply()) return reply;
    if (Clock::now() >= end) return std::nullopt;
    if (!pump(kGlance) && !process_->out.is_open()) fail_end();
    check_silence(options_.silence_limit);
  }
}

std::optional<Message<ReplyHead>> Connection::next_reply() {
  require_link();
  try {
    while (const auto bytes = reader_.next()) {
      const Message<ReplyHead> reply(*bytes);
      if (reply.head.code != kBeat) return reply;
    }
  } catch (const BadPacket& mistake) {
    fail_bad_message(mistake.what());
  }
  return std::nullopt;
}

// ---- The pipes ----

/// Writes and reads what can be written and read, after so much patience at most. Returns whether
/// something came.
bool Connection::pump(std::chrono::milliseconds patience) {
  const bool has_pending = written_ < pending_.size() && process_->in.is_open();
  pollfd files[3] = {{process_->out.number(), POLLIN, 0},
                     {process_->err.number(), POLLIN, 0},
                     {has_pending ? process_->in.number() : -1, POLLOUT, 0}};
  const int ready = ::poll(files, std::size(files), static_cast<int>(patience.count()));
  if (ready <= 0) return false;
  if (files[1].revents != 0) read_err();
  if (files[2].revents != 0) write_pending();
  return files[0].revents != 0 && read_out();
}

/// One whose other end is closed is noticed by reading.
void Connection::write_pending() {
  while (written_ < pending_.size() && process_->in.is_open()) {
    const ssize_t size = write_without_signal(process_->in.number(), pending_.data() + written_,
                                              pending_.size() - written_);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return;
    if (size < 0) {
      process_->in.close();
      return;
    }
    written_ += static_cast<std::size_t>(size);
    statistics_.sent += static_cast<std::uint64_t>(size);
  }
  pending_.clear();
  written_ = 0;
  if (pending_.capacity() > kKept) pending_ = {};
}

bool Connection::read_out() {
  const std::span<char> room = reader_.room();
  const ssize_t size = ::read(process_->out.number(), room.data(), room.size());
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (size <= 0) {
    process_->out.close();
    return false;
  }
  statistics_.received += static_cast<std::uint64_t>(size);
  heard_ = Clock::now();
  if (greeting_) {
    reader_.filled(static_cast<std::size_t>(size));
  } else {
    take_greeting(std::string(room.data(), static_cast<std::size_t>(size)));
  }
  return true;
}

void Connection::take_greeting(std::string_view bytes) {
  try {
    greeting_ = scanner_.take(bytes);
  } catch (const BadGreeting& mistake) {
    fail(fmt::format("{} does not answer as stride serve does: {}", machine(), mistake.what()));
  }
  if (!greeting_) return;
  const Greeting own = own_greeting();
  if (greeting_->protocol != own.protocol) {
    fail(fmt::format("stride {} on {} has protocol {}, and stride {} here has protocol {}",
                     greeting_->build, machine(), greeting_->protocol, own.build, own.protocol),
         "install the same version on both machines");
  }
  if (!scanner_.noise().empty() && options_.note) {
    options_.note(fmt::format("printed before stride serve began: '{}'",
                              core::readable_text(scanner_.noise(), kLongestLine)));
  }
  reader_.put(scanner_.rest());
}

void Connection::read_err() {
  const auto take = [&](std::string_view line) {
    if (last_lines_.size() == kMostLines) last_lines_.pop_front();
    last_lines_.push_back(core::readable_text(line, kLongestLine));
    if (options_.note) options_.note(last_lines_.back());
  };
  const std::size_t before = err_lines_.bytes().size();
  isolation::read_some(process_->err, err_lines_.bytes());
  err_text_ += std::string_view(err_lines_.bytes()).substr(before);
  if (err_text_.size() > kMostErrText) err_text_.erase(0, err_text_.size() - kMostErrText);
  err_lines_.take(take);
  if (!process_->err.is_open()) err_lines_.take_rest(take);
}

// ---- Failures ----

void Connection::check_silence(std::chrono::milliseconds limit) {
  if (Clock::now() - heard_ < limit) return;
  fail(greeting_ ? fmt::format("{} has given no sign of life for {} s{}", machine(), seconds(limit),
                               present_call())
                 : fmt::format("{} has not answered within {} s", machine(), seconds(limit)),
       greeting_ ? "a slow network may need a longer silenceLimit"
                 : "what needs longer, such as a queue of jobs, needs a longer connectLimit");
}

void Connection::check_interruption() {
  if (options_.interrupted == nullptr || *options_.interrupted == 0) return;
  const auto now = Clock::now();
  if (!interrupted_at_) interrupted_at_ = now;
  if (now - *interrupted_at_ <= kInterruptedPatience) return;
  fail(
      fmt::format("the run was interrupted, and {} was not done after a second{}, so the link was "
                  "ended; the results up to there are complete",
                  machine(), present_call()));
}

void Connection::fail_bad_message(const std::string& why) {
  fail(fmt::format("{} sends what cannot be read{}: {}", machine(), present_call(), why));
}

/// The program may have something to say, and its code.
void Connection::fail_end() {
  const auto end = Clock::now() + kLastWordsPatience;
  while (process_->err.is_open() && Clock::now() < end) pump(kGlance);
  process_->has_ended(kLastWordsPatience);
  const std::string how = process_->how_it_ended();
  const std::string program = options_.place.command.front() == "ssh" ? "ssh" : "the command";
  std::string what = greeting_
                         ? fmt::format("the link to {} has ended{}", machine(), present_call())
                         : fmt::format("there is no stride serve on {}", machine());
  if (!how.empty()) what += fmt::format(": {} {}", program, how);
  fail(what, hint_of_end());
}

std::string Connection::hint_of_end() const {
  const auto said = [&](std::string_view words) {
    return err_text_.find(words) != std::string::npos;
  };
  const bool is_ssh = options_.place.command.front() == "ssh";
  if (is_ssh && said("Host key verification failed")) {
    return "the key of that machine is not known here, or is another one now: connect once with "
           "ssh "
           "by hand, and compare it";
  }
  if (is_ssh && said("Permission denied")) {
    return "log in by a key that needs no answer, such as one in an agent (ssh-add)";
  }
  if (process_->exit_code() == 127) {
    return "install stride there, where a shell that is not a login finds it, or name its program: "
           "stride=\"/path/to/stride\"";
  }
  return "";
}

std::string Connection::last_words() const {
  std::string text;
  if (!greeting_ && !scanner_.noise().empty()) {
    text += fmt::format("\n  it printed: {}", core::readable_text(scanner_.noise(), kLongestLine));
  }
  for (const std::string& line : last_lines_) text += fmt::format("\n  it said: {}", line);
  return text;
}

std::string Connection::present_call() const { return fmt::format(" in {}", call_); }

void Connection::fail(const std::string& what, const std::string& hint) {
  failure_ = what;
  process_->in.close();
  throw core::EnvironmentError(options_.context, what + last_words(), hint);
}

}  // namespace stride::remote
