#include "master/front/cli/run/live/live_server.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

#include "master/base/error.h"
#include "tests/master/front/cli/live_client.h"

using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using stride::cli::LiveServer;
using stride::cli::parse_live_port;
using stride::tests::path_in;
using stride::tests::port_in;

namespace {

class Client : public stride::tests::LiveClient {
 public:
  explicit Client(const LiveServer& server) : LiveClient(port_in(server.address())) {}
};

struct Request {
  std::string method = "GET";
  std::string path{};  ///< behind the token
  std::string host{};  ///< empty: that of the address
  std::string more = "Connection: close\r\n";
};

std::string text_of(const LiveServer& server, const Request& request) {
  const std::string host =
      request.host.empty() ? fmt::format("127.0.0.1:{}", port_in(server.address())) : request.host;
  return fmt::format("{} {}{} HTTP/1.1\r\nHost: {}\r\n{}\r\n", request.method,
                     path_in(server.address()), request.path, host, request.more);
}

std::string answer(const LiveServer& server, const Request& request = {}) {
  Client client(server);
  client.send(text_of(server, request));
  return client.receive();
}

/// With pages that say how often one was made.
struct Bench {
  LiveServer server{0};
  std::atomic<int> pages{0};

  Bench() {
    server.start([this](bool is_over) {
      return fmt::format("page {}{}", ++pages, is_over ? ", the last" : "");
    });
  }
};

}  // namespace

TEST_CASE("the page is made anew for each request") {
  Bench bench;
  const std::string first = answer(bench.server);
  CHECK_THAT(first, StartsWith("HTTP/1.1 200 OK\r\n") && EndsWith("\r\n\r\npage 1"));
  CHECK_THAT(first, Contains("Content-Type: text/html; charset=utf-8\r\n") &&
                        Contains("Cache-Control: no-store\r\n") &&
                        Contains("Referrer-Policy: no-referrer\r\n"));
  CHECK_THAT(answer(bench.server), EndsWith("page 2"));
  const std::string head = answer(bench.server, {.method = "HEAD"});
  CHECK_THAT(head, StartsWith("HTTP/1.1 200 OK\r\n") && Contains("Content-Length: 6\r\n") &&
                       EndsWith("\r\n\r\n"));
}

TEST_CASE("several requests go over one connection") {
  Bench bench;
  Client client(bench.server);
  client.send(text_of(bench.server, {.more = ""}));
  client.receive("page 1");
  client.send(text_of(bench.server, {}));
  CHECK_THAT(client.receive(), EndsWith("page 2"));
}

TEST_CASE("only who knows the token sees the page") {
  Bench bench;
  const std::string token = path_in(bench.server.address());
  CHECK(token.size() == 34);
  const LiveServer other(0);
  CHECK(path_in(other.address()) != token);
  const auto status_of = [&](const std::string& target) {
    Client client(bench.server);
    client.send(fmt::format("GET {} HTTP/1.1\r\nHost: localhost:{}\r\nConnection: close\r\n\r\n",
                            target, port_in(bench.server.address())));
    return client.receive().substr(9, 3);
  };
  CHECK(status_of(token) == "200");
  for (const std::string& target :
       {std::string("/"), token.substr(0, 33), token + "x", path_in(other.address()),
        std::string("/events"), token + "../", token + "events/"}) {
    INFO(target);
    CHECK(status_of(target) == "404");
  }
  CHECK(bench.pages == 1);
}

TEST_CASE("a name of another host that leads here is refused") {
  Bench bench;
  const std::uint16_t port = port_in(bench.server.address());
  CHECK_THAT(answer(bench.server, {.host = fmt::format("localhost:{}", port)}),
             StartsWith("HTTP/1.1 200 "));
  for (const std::string& host :
       {fmt::format("example.org:{}", port), std::string("127.0.0.1"), std::string("localhost:1"),
        fmt::format("127.0.0.1:{}.example.org", port)}) {
    INFO(host);
    CHECK_THAT(answer(bench.server, {.host = host}), StartsWith("HTTP/1.1 403 "));
    CHECK_THAT(answer(bench.server, {.path = "events", .host = host}), StartsWith("HTTP/1.1 403 "));
  }
  CHECK(bench.pages == 1);
}

TEST_CASE("nothing can be sent to the page") {
  Bench bench;
  for (const char* const method : {"PUT", "DELETE", "OPTIONS", "POST"}) {
    INFO(method);
    CHECK_THAT(answer(bench.server, {.method = method}),
               StartsWith("HTTP/1.1 405 ") && Contains("Allow: GET, HEAD\r\n"));
  }
  // no answer to what is no request, or has no end
  for (const std::string& text :
       {std::string("\x16\x03\x01 no HTTP\r\n\r\n"), "GET /" + std::string(20'000, 'a')}) {
    Client client(bench.server);
    client.send(text);
    CHECK(client.receive() == "");
  }
  CHECK_THAT(answer(bench.server), EndsWith("page 1"));
}

TEST_CASE("a page that cannot be made is told") {
  LiveServer server(0);
  server.start([](bool) -> std::string { throw std::runtime_error("signals.csv:7: no number"); });
  CHECK_THAT(answer(server), StartsWith("HTTP/1.1 500 ") && EndsWith("signals.csv:7: no number\n"));
}

TEST_CASE("those who look on are told of what is new, and of the end") {
  Bench bench;
  Client one(bench.server);
  Client other(bench.server);
  for (Client* const client : {&one, &other}) {
    client->send(text_of(bench.server, {.path = "events"}));
    CHECK_THAT(client->receive("data: 1\n\n"),
               StartsWith("HTTP/1.1 200 OK\r\n") &&
                   Contains("Content-Type: text/event-stream\r\n") &&
                   EndsWith("\r\n\r\nevent: update\ndata: 1\n\n"));
  }
  bench.server.announce_update();
  CHECK_THAT(one.receive("data: 2\n\n"), EndsWith("event: update\ndata: 2\n\n"));
  CHECK_THAT(other.receive("data: 2\n\n"), EndsWith("event: update\ndata: 2\n\n"));
  auto end = std::async(std::launch::async, [&] { bench.server.end(); });
  for (Client* const client : {&one, &other}) {
    CHECK_THAT(client->receive(), EndsWith("event: end\ndata: 3\n\n"));
    CHECK(end.wait_for(0s) == std::future_status::timeout);
    CHECK_THAT(answer(bench.server), EndsWith(", the last"));
  }
  end.get();
}

TEST_CASE("the end does not wait for those who have gone, hang, or only look at the page") {
  Bench bench;
  {
    Client gone(bench.server);
    gone.send(text_of(bench.server, {.path = "events"}));
    gone.receive("data: 1\n\n");
  }
  Client silent(bench.server);
  Client half(bench.server);
  half.send("GET / HT");
  Client kept(bench.server);
  kept.send(text_of(bench.server, {.more = ""}));
  CHECK_THAT(kept.receive("page 1"), EndsWith("page 1"));
  bench.server.announce_update();
  bench.server.end();
  CHECK(silent.receive() == "");
  CHECK(half.receive() == "");
}

TEST_CASE("strangers make room for who knows the address, and friends do not") {
  constexpr int kMost = 32;
  Bench bench;
  std::vector<std::unique_ptr<Client>> silent;
  for (int i = 0; i < kMost; ++i) silent.push_back(std::make_unique<Client>(bench.server));
  CHECK_THAT(answer(bench.server), EndsWith("page 1"));
  CHECK(silent.front()->receive() == "");  // the oldest
  std::vector<std::unique_ptr<Client>> friends;
  for (int i = 0; i < kMost; ++i) {
    friends.push_back(std::make_unique<Client>(bench.server));
    friends.back()->send(text_of(bench.server, {.more = ""}));
    friends.back()->receive("page ");
  }
  for (const auto& client : silent) CHECK(client->receive() == "");
  CHECK(Client(bench.server).receive() == "");
  friends.front()->send(text_of(bench.server, {.more = ""}));
  CHECK_THAT(friends.front()->receive(), Contains("page"));
}

TEST_CASE("who takes a large page slowly gets all of it, and who takes nothing is one less") {
  constexpr std::size_t kSize = std::size_t{48} << 20;  // more than the system keeps of it
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  constexpr auto kPatience = 1s;
  LiveServer server(0, kPatience);
  server.start([](bool) { return std::string(kSize, 'x') + "the last line"; });
  Client silent(server);
  Client slow(server);
  Client idle(server);
  for (Client* const client : {&slow, &idle}) client->send(text_of(server, {}));
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t size = kPiece; size < kSize && slow.receive_size(size) >= size; size += kPiece) {
    std::this_thread::sleep_for(50ms);
  }
  CHECK(std::chrono::steady_clock::now() - begin > 2 * kPatience);
  // not by matchers, which would print all of it
  const bool is_whole = slow.receive().ends_with("xxxthe last line");
  CHECK(is_whole);
  const bool is_cut = !idle.receive().ends_with("the last line");
  CHECK(is_cut);
  CHECK(silent.receive() == "");
}

TEST_CASE("a server that cannot be started says what is missing") {
  LiveServer server(0);
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const rlimit none{0, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  std::string text = "no failure";
  try {
    server.start([](bool) { return std::string(); });
  } catch (const stride::core::Error& error) {
    text = error.what();
  } catch (const std::exception& error) {
    text = std::string("of the library: ") + error.what();
  }
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
  CHECK_THAT(text, StartsWith("--live: cannot serve the page: ") &&
                       Contains("Too many open files") && Contains("ulimit -n"));
  CHECK(!server.has_started());
}

TEST_CASE("the port is one of the loopback, and can be named") {
  LiveServer server(0);
  CHECK_THAT(server.address(), StartsWith("http://127.0.0.1:"));
  const std::uint16_t port = port_in(server.address());
  try {
    LiveServer again(port);
    FAIL("the port is taken");
  } catch (const stride::core::Error& error) {
    CHECK(error.kind() == stride::core::Error::Kind::Input);
    CHECK_THAT(error.what(), Contains(fmt::format("--live={}: this port cannot be had", port)) &&
                                 Contains("--live takes one that is free"));
  }
}

TEST_CASE("the port of --live is a number") {
  CHECK(parse_live_port("8080") == 8080);
  CHECK(parse_live_port("65535") == 65535);
  for (const char* const text : {"0", "65536", "-1", "http", "80a", "", "123456"}) {
    INFO(text);
    CHECK_THROWS_WITH(parse_live_port(text), Contains("expected the number of a port, 1 to 65535"));
  }
}

TEST_CASE("programs that are started inherit nothing of it") {
  Bench bench;
  Client client(bench.server);
  client.send(text_of(bench.server, {.path = "events"}));
  client.receive("data: 1\n\n");
  FILE* const listing = ::popen("ls -l /proc/self/fd", "re");
  REQUIRE(listing != nullptr);
  std::string text;
  for (char line[512]; std::fgets(line, sizeof line, listing) != nullptr;) text += line;
  ::pclose(listing);
  // but the test's own end
  std::size_t sockets = 0;
  for (std::size_t at = 0; (at = text.find("socket:", at)) != text.npos; ++at) ++sockets;
  INFO(text);
  CHECK(sockets == 1);
  CHECK_THAT(text, !Contains("eventpoll"));
}
