// The server's end of the two pipes.
#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVER_CHANNEL_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVER_CHANNEL_H

#include <atomic>
#include <csignal>
#include <cstdint>
#include <latch>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "master/loader/network/frame.h"
#include "master/loader/network/greeting.h"
#include "master/loader/network/message.h"

namespace stride::remote {

/// The master has ended, or the link to it has.
class LinkEnded : public std::runtime_error {
 public:
  LinkEnded() : std::runtime_error("the link to the master has ended") {}
};

/// Reads requests and writes replies. A thread of its own watches the link meanwhile: it sends
/// signs of life, four a second while a request is carried out and seldom otherwise, and when the
/// link ends it sets is_over(), for what waits for a unit; if that has no effect the process ends.
///
/// Once it has begun, that thread takes no lock of others and allocates nothing, so the process may
/// be forked.
class ServerChannel {
 public:
  /// `interrupted`: set by a signal handler to end the session. None of the files is closed.
  ServerChannel(int in, int out, const volatile std::sig_atomic_t& interrupted);
  ~ServerChannel();
  ServerChannel(const ServerChannel&) = delete;
  ServerChannel& operator=(const ServerChannel&) = delete;

  /// Sends this side's greeting and awaits the other's. Throws LinkEnded, and BadGreeting.
  Greeting greet();
  /// From here on there are messages. To be called once, behind greet().
  void begin();

  /// The next message; its bytes stay until the next call. Throws LinkEnded, and BadPacket.
  std::span<const std::byte> receive();
  /// Sends a message. Throws LinkEnded, and BadPacket if it is too long. Any thread may send.
  void send(const ReplyHead& head, const PacketWriter& packet);

  /// Whether a request is being carried out.
  void set_busy(bool is_busy) { is_busy_ = is_busy; }
  /// Not 0 when the session is to end.
  const volatile std::sig_atomic_t& is_over() const { return is_over_; }

 private:
  std::size_t read(std::span<char> to);
  void write();
  bool write_some(std::string_view bytes) noexcept;
  void watch() noexcept;
  void beat() noexcept;

  int in_, out_;
  const volatile std::sig_atomic_t& interrupted_;
  FrameReader reader_;
  std::mutex mutex_;  ///< of what follows, and of writing
  std::string bytes_;
  std::string beat_;  ///< a sign of life
  std::atomic<bool> is_busy_ = false;
  std::atomic<bool> is_done_ = false;
  volatile std::sig_atomic_t is_over_ = 0;
  std::latch watches_{1};
  std::thread watch_;
};

}  // namespace stride::remote

#endif
