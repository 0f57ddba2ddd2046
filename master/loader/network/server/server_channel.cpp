#include "master/loader/network/server/server_channel.h"

#include <cerrno>
#include <chrono>

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kWatchGlance = 100;  // [ms]
constexpr auto kBusyBeat = 250ms;
constexpr auto kIdleBeat = 15s;
/// From the end of the link to that of this process, at most. A unit that is being called has a
/// second, and its processes some more to end.
constexpr auto kLongestEnd = 10s;

bool has_room(int file) {
  pollfd wanted{file, POLLOUT, 0};
  return ::poll(&wanted, 1, 0) == 1 && (wanted.revents & POLLOUT) != 0;
}

/// Whether nobody writes to it any longer; what was written before does not matter then.
bool is_hung_up(int file) {
  pollfd watched{file, POLLRDHUP, 0};
  return ::poll(&watched, 1, kWatchGlance) == 1 &&
         (watched.revents & (POLLHUP | POLLRDHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace

ServerChannel::ServerChannel(int in, int out, const volatile std::sig_atomic_t& interrupted)
    : in_(in), out_(out), interrupted_(interrupted) {
  append_message(beat_, ReplyHead{.code = kBeat}, {});
}

ServerChannel::~ServerChannel() {
  is_done_ = true;
  if (watch_.joinable()) watch_.join();
}

Greeting ServerChannel::greet() {
  bytes_ = greeting_line(Side::Server, own_greeting());
  write();
  GreetingScanner scanner(Side::Master);
  char bytes[4096];
  for (;;) {
    const std::size_t size = read(bytes);
    if (const auto greeting = scanner.take({bytes, size})) {
      if (!scanner.noise().empty()) throw BadGreeting("what came first is no greeting");
      reader_.put(scanner.rest());
      return *greeting;
    }
  }
}

/// Signals are for the thread that calls units. That one may fork when this returns, which must not
/// be while the other one is being made: the libraries' locks for it would be held in the fork.
void ServerChannel::begin() {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  watch_ = std::thread([this] { watch(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  watches_.wait();
}

std::span<const std::byte> ServerChannel::receive() {
  for (;;) {
    if (const auto message = reader_.next()) return *message;
    const std::span<char> room = reader_.room();
    reader_.filled(read(room));
  }
}

void ServerChannel::send(const ReplyHead& head, const PacketWriter& packet) {
  constexpr std::size_t kKept = std::size_t{1} << 22;
  const std::lock_guard lock(mutex_);
  bytes_.clear();
  append_message(bytes_, head, packet.bytes());
  write();
  if (bytes_.capacity() > kKept) bytes_ = {};
}

std::size_t ServerChannel::read(std::span<char> to) {
  for (;;) {
    const ssize_t size = ::read(in_, to.data(), to.size());
    if (size > 0) return static_cast<std::size_t>(size);
    if (size < 0 && errno == EINTR && interrupted_ == 0) continue;
    throw LinkEnded();
  }
}

void ServerChannel::write() {
  if (!write_some(bytes_)) throw LinkEnded();
}

bool ServerChannel::write_some(std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t size = ::write(out_, bytes.data(), bytes.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(size));
  }
  return true;
}

void ServerChannel::watch() noexcept {
  watches_.count_down();
  auto last = Clock::now();
  std::optional<Clock::time_point> end;
  while (!is_done_) {
    if (!end && (is_hung_up(in_) || interrupted_ != 0)) {
      is_over_ = 1;
      end = Clock::now() + kLongestEnd;
    }
    const auto now = Clock::now();
    if (end) {
      if (now >= *end) {
        archive::TemporaryFolder::remove_all(::getpid());
        ::_exit(1);
      }
      ::usleep(useconds_t{1000} * kWatchGlance);
    } else if (now - last >= (is_busy_ ? kBusyBeat : kIdleBeat)) {
      beat();
      last = now;
    }
  }
}

/// None where one would have to be waited for: who does not read knows that this side is there.
void ServerChannel::beat() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock && has_room(out_)) write_some(beat_);
}

}  // namespace stride::remote
