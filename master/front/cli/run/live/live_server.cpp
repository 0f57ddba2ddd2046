#include "master/front/cli/run/live/live_server.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <exception>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include "master/base/blocked_signals.h"
#include "master/base/error.h"
#include "master/base/files/descriptor.h"

namespace stride::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::use_awaitable;
using asio::ip::tcp;
using namespace std::chrono_literals;

constexpr std::size_t kMostConnections = 32;
constexpr std::uint32_t kLongestHeader = 8192;
/// What the system keeps of an answer: so small that a slow client is seen to take something.
constexpr int kSendBuffer = 256 * 1024;
/// So that clients, and what is between, know that the other side is there.
constexpr auto kSignOfLife = 15s;
/// For the request of the last page, and until it is made and sent.
constexpr auto kLastMoment = 2s, kLastPage = 8s;
constexpr auto kPoll = 5ms;

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    core::fail_run({}, "--live: the system has no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

[[noreturn]] void fail_to_listen(std::uint16_t port, int error) {
  const std::string reason = std::generic_category().message(error);
  if (error != EADDRINUSE && error != EACCES) {
    core::fail_run({}, fmt::format("--live: cannot listen at port {}: {}", port, reason));
  }
  core::fail_input({}, fmt::format("--live={}: this port cannot be had: {}", port, reason),
                   "name another one, or none: --live takes one that is free");
}

core::Descriptor listening_at(std::uint16_t port) {
  core::Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;  // the port of a run that has just ended can be had
  if (!listener.is_open() ||
      ::setsockopt(listener.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      ::bind(listener.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.number(), SOMAXCONN) != 0) {
    fail_to_listen(port, errno);
  }
  return listener;
}

std::uint16_t port_of(int listener) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    core::fail_run({}, "--live: the system does not tell the port");
  }
  return ntohs(address.sin_port);
}

core::Descriptor duplicate_of(int file) {
  core::Descriptor duplicate(::fcntl(file, F_DUPFD_CLOEXEC, 0));
  if (!duplicate.is_open()) throw std::system_error(errno, std::generic_category());
  return duplicate;
}

/// The connections that have not asked for what is served yet, the oldest first.
using Strangers = std::list<beast::tcp_stream*>;

/// A connection is one of these until it leaves, or ends.
class Stranger {
 public:
  Stranger(Strangers& all, beast::tcp_stream& stream)
      : all_(all), place_(all.insert(all.end(), &stream)) {}
  ~Stranger() { leave(); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void leave() {
    if (const auto place = std::exchange(place_, std::nullopt)) all_.erase(*place);
  }

 private:
  Strangers& all_;
  std::optional<Strangers::iterator> place_;
};

/// Counts for as long as it exists.
class Counted {
 public:
  explicit Counted(std::size_t& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::size_t& count_;
};

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

Response response_to(const Request& request, http::status status, std::string body,
                     std::string_view type = "text/plain; charset=utf-8") {
  Response response(status, request.version());
  response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.keep_alive(request.keep_alive());
  const std::size_t size = body.size();
  if (request.method() != http::verb::head) response.body() = std::move(body);
  response.content_length(size);
  return response;
}

bool is_read(const Request& request) {
  return request.method() == http::verb::get || request.method() == http::verb::head;
}

}  // namespace

/// All but the constructor, announce_update() and end() happens in one thread, and what makes pages
/// in another one.
class LiveServer::Connections {
 public:
  Connections(const LiveServer& server, MakePage make_page);

  void announce_update() {
    asio::post(context_, [this] { tell_update(); });
  }
  void end();

 private:
  struct Site {
    std::string page, events, host, other_host;
  };

  void tell_update();
  asio::awaitable<void> accept();
  asio::awaitable<void> serve(tcp::socket socket);
  bool turn_stranger_away();
  bool is_here(const Request& request) const;
  bool is_of_friend(const Request& request) const;
  asio::awaitable<bool> answer(beast::tcp_stream& stream, const Request& request);
  asio::awaitable<Response> page_for(const Request& request);
  asio::awaitable<void> send(beast::tcp_stream& stream, Response& response);
  asio::awaitable<void> send(beast::tcp_stream& stream, std::string text);
  asio::awaitable<void> send_events(beast::tcp_stream& stream);
  asio::awaitable<void> end_all();

  template <class Coroutine>
  void spawn(Coroutine&& coroutine) {
    asio::co_spawn(context_, std::forward<Coroutine>(coroutine), asio::detached);
  }

  const Site site_;
  const MakePage make_page_;
  const std::chrono::milliseconds patience_;
  std::size_t open_ = 0;       ///< connections
  Strangers strangers_;        ///< among them
  std::size_t listeners_ = 0;  ///< to events
  std::size_t in_work_ = 0;    ///< pages that are made or sent
  std::size_t last_pages_ = 0;
  std::uint64_t version_ = 1;  ///< counts what was new
  bool is_over_ = false;
  std::set<asio::steady_timer*> waiting_;  ///< of listeners
  // joined before the context ends, whose coroutines it calls back
  std::optional<asio::thread_pool> maker_;
  asio::io_context context_{1};
  asio::posix::stream_descriptor listener_{context_};
  std::thread thread_;
};

LiveServer::Connections::Connections(const LiveServer& server, MakePage make_page)
    : site_{fmt::format("/{}/", server.token_), fmt::format("/{}/events", server.token_),
            fmt::format("127.0.0.1:{}", server.port_), fmt::format("localhost:{}", server.port_)},
      make_page_(std::move(make_page)),
      patience_(server.patience_) {
  listener_.assign(duplicate_of(server.listener_).release());
  spawn(accept());
  const core::BlockedSignals blocked;
  maker_.emplace(1);
  thread_ = std::thread([this] { context_.run(); });
}

void LiveServer::Connections::end() {
  asio::post(context_, [this] { spawn(end_all()); });
  thread_.join();
  maker_->join();
}

void LiveServer::Connections::tell_update() {
  ++version_;
  for (asio::steady_timer* const timer : waiting_) timer->cancel();
}

asio::awaitable<void> LiveServer::Connections::end_all() {
  const auto begin = std::chrono::steady_clock::now();
  const auto is_within = [&](auto time) { return std::chrono::steady_clock::now() - begin < time; };
  const std::size_t awaited = listeners_;
  is_over_ = true;
  tell_update();
  asio::steady_timer timer(context_);
  while ((last_pages_ < awaited && is_within(kLastMoment)) ||
         (in_work_ > 0 && is_within(kLastPage))) {
    timer.expires_after(kPoll);
    co_await timer.async_wait(use_awaitable);
  }
  context_.stop();
}

/// Not by Asio, which leaves sockets open in programs that are started.
asio::awaitable<void> LiveServer::Connections::accept() {
  for (;;) {
    co_await listener_.async_wait(asio::posix::descriptor_base::wait_read, use_awaitable);
    core::Descriptor accepted(
        ::accept4(listener_.native_handle(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!accepted.is_open()) {
      if (errno == EAGAIN || errno == EINTR || errno == ECONNABORTED) continue;
      asio::steady_timer timer(context_, kPoll);  // too many open files, say
      co_await timer.async_wait(use_awaitable);
      continue;
    }
    if (open_ >= kMostConnections && !turn_stranger_away()) continue;
    tcp::socket socket(context_);
    socket.assign(tcp::v4(), accepted.release());
    boost::system::error_code ignored;
    socket.set_option(tcp::socket::send_buffer_size(kSendBuffer), ignored);
    spawn(serve(std::move(socket)));
  }
}

/// So that those who do not know the address cannot keep out those who do. Returns whether there
/// was one, which ends soon.
bool LiveServer::Connections::turn_stranger_away() {
  if (strangers_.empty()) return false;
  strangers_.front()->cancel();
  strangers_.splice(strangers_.end(), strangers_, strangers_.begin());
  return true;
}

bool LiveServer::Connections::is_here(const Request& request) const {
  const beast::string_view host = request[http::field::host];
  return host == site_.host || host == site_.other_host;
}

bool LiveServer::Connections::is_of_friend(const Request& request) const {
  return is_here(request) && is_read(request) &&
         (request.target() == site_.page || request.target() == site_.events);
}

/// A client that breaks off, or is too slow, is one less.
asio::awaitable<void> LiveServer::Connections::serve(tcp::socket socket) {
  const Counted counted(open_);
  try {
    beast::tcp_stream stream(std::move(socket));
    Stranger stranger(strangers_, stream);
    beast::flat_buffer buffer;
    for (bool goes_on = true; goes_on;) {
      http::request_parser<http::empty_body> parser;
      parser.header_limit(kLongestHeader);
      stream.expires_after(patience_);
      co_await http::async_read(stream, buffer, parser, use_awaitable);
      if (is_of_friend(parser.get())) stranger.leave();
      goes_on = co_await answer(stream, parser.get());
    }
    stream.socket().shutdown(tcp::socket::shutdown_send);
  } catch (const boost::system::system_error&) {
  }
}

/// Returns whether the connection goes on.
asio::awaitable<bool> LiveServer::Connections::answer(beast::tcp_stream& stream,
                                                      const Request& request) {
  const Counted counted(in_work_);
  const bool is_last = is_over_;
  std::optional<Response> response;
  if (!is_here(request)) {
    response = response_to(request, http::status::forbidden, "This host is not served here.\n");
  } else if (!is_read(request)) {
    response = response_to(request, http::status::method_not_allowed, "Only GET and HEAD.\n");
    response->set(http::field::allow, "GET, HEAD");
  } else if (request.target() == site_.events && request.method() == http::verb::get) {
    co_await send_events(stream);
    co_return false;
  } else if (request.target() == site_.page) {
    response = co_await page_for(request);
  } else {
    response = response_to(request, http::status::not_found, "There is no such page here.\n");
  }
  co_await send(stream, *response);
  if (is_last && request.target() == site_.page) ++last_pages_;
  co_return response->keep_alive();
}

asio::awaitable<Response> LiveServer::Connections::page_for(const Request& request) {
  std::string text, mistake;
  try {
    text = co_await asio::co_spawn(
        *maker_,
        [this, is_over = is_over_]() -> asio::awaitable<std::string> {
          co_return make_page_(is_over);
        },
        use_awaitable);
  } catch (const std::exception& failure) {
    mistake = failure.what();
  }
  if (!mistake.empty()) {
    co_return response_to(request, http::status::internal_server_error, mistake + "\n");
  }
  co_return response_to(request, http::status::ok, std::move(text), "text/html; charset=utf-8");
}

/// However long a large page takes, as through a tunnel.
asio::awaitable<void> LiveServer::Connections::send(beast::tcp_stream& stream, Response& response) {
  http::response_serializer<http::string_body> rest(response);
  while (!rest.is_done()) {
    stream.expires_after(patience_);
    co_await http::async_write_some(stream, rest, use_awaitable);
  }
}

asio::awaitable<void> LiveServer::Connections::send(beast::tcp_stream& stream, std::string text) {
  stream.expires_after(patience_);
  co_await asio::async_write(stream, asio::buffer(text), use_awaitable);
  stream.expires_never();
}

asio::awaitable<void> LiveServer::Connections::send_events(beast::tcp_stream& stream) {
  const Counted counted(listeners_);
  --in_work_;  // it is not waited for
  struct Again {
    std::size_t& in_work;
    ~Again() { ++in_work; }
  } const again{in_work_};
  co_await send(stream,
                "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\n"
                "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n");
  asio::steady_timer timer(context_);
  for (std::uint64_t told = 0; !is_over_;) {
    if (told != version_) {
      told = version_;
      co_await send(stream, fmt::format("event: update\ndata: {}\n\n", told));
      continue;
    }
    timer.expires_after(kSignOfLife);
    waiting_.insert(&timer);
    boost::system::error_code error;
    co_await timer.async_wait(asio::redirect_error(use_awaitable, error));
    waiting_.erase(&timer);
    if (!error) co_await send(stream, ": the run goes on\n\n");
  }
  co_await send(stream, fmt::format("event: end\ndata: {}\n\n", version_));
}

std::uint16_t parse_live_port(const std::string& text) {
  constexpr std::uint64_t kMost = 65535;
  const bool is_number = !text.empty() && text.size() <= 5 &&
                         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  const std::uint64_t port = is_number ? std::stoul(text) : 0;
  if (port > 0 && port <= kMost) return static_cast<std::uint16_t>(port);
  core::fail_input({},
                   fmt::format("--live={}: expected the number of a port, 1 to {}", text, kMost),
                   "--live alone takes one that is free");
}

LiveServer::LiveServer(std::uint16_t port, std::chrono::milliseconds patience)
    : listener_(listening_at(port).release()),
      patience_(patience),
      token_(random_token()),
      port_(port_of(listener_)) {
  address_ = fmt::format("http://127.0.0.1:{}/{}/", port_, token_);
}

LiveServer::~LiveServer() {
  end();
  ::close(listener_);
}

void LiveServer::start(MakePage make_page) {
  try {
    connections_ = std::make_unique<Connections>(*this, std::move(make_page));
  } catch (const std::runtime_error& failure) {  // Boost's are not always std::system_error
    core::fail_run({}, fmt::format("--live: cannot serve the page: {}", failure.what()),
                   "raise the limits of open files (ulimit -n) and of threads (ulimit -u)");
  }
}

void LiveServer::announce_update() { connections_->announce_update(); }

void LiveServer::end() {
  if (connections_ == nullptr) return;
  connections_->end();
  connections_.reset();
}

}  // namespace stride::cli
