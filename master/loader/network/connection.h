// The master's end of the link to a `stride serve`.
#ifndef STRIDE_MASTER_LOADER_NETWORK_CONNECTION_H
#define STRIDE_MASTER_LOADER_NETWORK_CONNECTION_H

#include <chrono>
#include <csignal>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "master/base/error.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/loader/network/command_process.h"
#include "master/loader/network/frame.h"
#include "master/loader/network/greeting.h"
#include "master/loader/network/message.h"
#include "master/loader/network/place.h"
#include "master/loader/process/output_tail.h"

namespace stride::remote {

struct ConnectionOptions {
  Place place;
  core::Context context{};  ///< the component's place and name, for errors
  /// From the start to the greeting.
  std::chrono::milliseconds connect_limit = std::chrono::seconds(60);
  /// How long the machine may give no sign of life while an answer is awaited.
  std::chrono::milliseconds silence_limit = std::chrono::seconds(30);
  /// What is set to another value than 0 to end a wait; null = nothing.
  const volatile std::sig_atomic_t* interrupted = nullptr;
  /// Takes what the machine says beside the unit: what ssh prints, and the like.
  std::function<void(const std::string& line)> note{};
};

/// Sends requests and awaits their answers. Each failure of the link is a core::EnvironmentError,
/// or another core::Error of the kind Run, with the machine, what was being done, the simulated
/// time and the last words of the machine; after it nothing can be sent. Not for several threads.
class Connection {
 public:
  /// Starts the program, and waits for nothing. Throws core::Error.
  explicit Connection(ConnectionOptions options);
  /// Gives the other side some time to end, and ends what is left of this one.
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& machine() const { return options_.place.machine; }
  /// The simulated time, for errors.
  void set_time(std::optional<Time> time) { options_.context.time = time; }

  /// Awaits the other's greeting, and compares versions. To be called once, before the others.
  void greet();

  /// For the packet of a request, which replaces the one before. Throws if the link has failed.
  PacketWriter write();
  /// Puts a request that is not awaited into what is to be sent.
  void put(RequestCode request, const PacketWriter& packet);
  /// Sends a request and what was put before, as far as the other side takes it. `call`: what it is
  /// for, in words for errors, a literal.
  void send(RequestCode request, const PacketWriter& packet, const char* call);
  /// Awaits the next reply that is not a sign of life; it stays until the next call.
  Message<ReplyHead> receive();
  /// The same for no longer than the limit; nothing if there is none.
  std::optional<Message<ReplyHead>> receive(std::chrono::milliseconds limit);

  /// For a message that cannot be read.
  [[noreturn]] void fail_bad_message(const std::string& why);
  /// Nothing can be sent any longer.
  bool has_failed() const { return !failure_.empty(); }

  core::LinkStatistics& statistics() { return statistics_; }
  const core::LinkStatistics& statistics() const { return statistics_; }

 private:
  using Clock = std::chrono::steady_clock;

  void require_link() const;
  void append(RequestCode request, bool is_awaited, const PacketWriter& packet);
  bool pump(std::chrono::milliseconds patience);
  void write_pending();
  bool read_out();
  void read_err();
  void take_greeting(std::string_view bytes);
  std::optional<Message<ReplyHead>> next_reply();
  void check_silence(std::chrono::milliseconds limit);
  void check_interruption();
  [[noreturn]] void fail_end();
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "");
  std::string hint_of_end() const;
  std::string last_words() const;
  std::string present_call() const;

  ConnectionOptions options_;
  std::optional<CommandProcess> process_;
  GreetingScanner scanner_{Side::Server};
  std::optional<Greeting> greeting_;
  FrameReader reader_;
  isolation::PacketBuffer packet_;
  std::string pending_;      ///< to be written,
  std::size_t written_ = 0;  ///< of it
  isolation::PrintedLines err_lines_;
  std::deque<std::string> last_lines_;
  std::string err_text_;  ///< its end, for hints
  const char* call_ = "the connection";
  Clock::time_point heard_;  ///< the last sign of life, or the begin of a wait
  std::optional<Clock::time_point> interrupted_at_;
  core::LinkStatistics statistics_;
  std::string failure_;
};

}  // namespace stride::remote

#endif
