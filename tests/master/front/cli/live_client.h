// A client of a live page that sends what it is told to.
#ifndef STRIDE_TESTS_MASTER_FRONT_CLI_LIVE_CLIENT_H
#define STRIDE_TESTS_MASTER_FRONT_CLI_LIVE_CLIENT_H

#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <catch2/catch.hpp>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "master/base/files/descriptor.h"

namespace stride::tests {

/// Of "http://127.0.0.1:PORT/TOKEN/".
inline std::uint16_t port_in(const std::string& address) {
  return static_cast<std::uint16_t>(std::stoul(address.substr(address.find(':', 7) + 1)));
}

inline std::string path_in(const std::string& address) {
  return address.substr(address.find('/', 8));
}

class LiveClient {
 public:
  explicit LiveClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval patience{30, 0};
    ::setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket_.number(), reinterpret_cast<const sockaddr*>(&address),
                      sizeof address) == 0);
  }

  void send(const std::string& text) {
    REQUIRE(::send(socket_.number(), text.data(), text.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(text.size()));
  }
  /// Asks for what is there, and lets the connection end with the answer.
  void get(const std::string& address, const std::string& file = {}) {
    send("GET " + path_in(address) + file + " HTTP/1.1\r\nHost: 127.0.0.1:" +
         std::to_string(port_in(address)) + "\r\nConnection: close\r\n\r\n");
  }
  /// So much, or less if the other side has closed the connection. Returns how much there is.
  std::size_t receive_size(std::size_t size) {
    char piece[4096];
    while (received_.size() < size) {
      const ssize_t more = ::recv(socket_.number(), piece, sizeof piece, 0);
      if (more <= 0) break;
      received_.append(piece, static_cast<std::size_t>(more));
    }
    return received_.size();
  }
  /// All until the other side has closed the connection, or until this is in it.
  std::string receive(const std::string& until = {}) {
    char piece[4096];
    while (until.empty() || received_.find(until) == std::string::npos) {
      const ssize_t size = ::recv(socket_.number(), piece, sizeof piece, 0);
      if (size <= 0) break;
      received_.append(piece, static_cast<std::size_t>(size));
    }
    return received_;
  }

 private:
  core::Descriptor socket_;
  std::string received_;
};

}  // namespace stride::tests

#endif
