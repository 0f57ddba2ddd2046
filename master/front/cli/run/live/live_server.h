// The page of a run that goes on, for browsers on the same machine.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_LIVE_LIVE_SERVER_H
#define STRIDE_MASTER_FRONT_CLI_RUN_LIVE_LIVE_SERVER_H

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace stride::cli {

/// From the text of --live=PORT. Throws core::Error (Input).
std::uint16_t parse_live_port(const std::string& text);

/// Serves one page at http://127.0.0.1:PORT/TOKEN/, and at TOKEN/events a stream of events:
/// "update" where there is something new, also at its beginning, and "end" when the run is over.
/// The token is a random number, which other users of the machine do not know; only requests whose
/// Host is this machine itself are answered, so pages of other hosts cannot have their names lead
/// here.
///
/// Its threads take no signals, and call no unit. Its files are closed in programs that are started
/// meanwhile.
class LiveServer {
 public:
  /// Makes the page, in a thread of the server. `is_over`: the last one.
  using MakePage = std::function<std::string(bool is_over)>;

  /// Takes the port, or a free one if it is 0; answers nothing yet. `patience`: with a client that
  /// sends or takes nothing. Throws core::Error: Input if the port is taken.
  explicit LiveServer(std::uint16_t port,
                      std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// Behind end().
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  const std::string& address() const { return address_; }

  /// Answers from here on. Throws core::Error (Run) if there can be no further files or threads.
  void start(MakePage make_page);
  bool has_started() const { return connections_ != nullptr; }
  /// There is something new. Does not wait for anybody.
  void announce_update();
  /// The last page can be made. Waits until those who look on have it, but not for more than 2 s
  /// until they ask for it, and closes all connections.
  void end();

 private:
  class Connections;

  int listener_;
  std::chrono::milliseconds patience_;
  std::string token_;
  std::string address_;
  std::uint16_t port_ = 0;
  std::unique_ptr<Connections> connections_;
};

}  // namespace stride::cli

#endif
