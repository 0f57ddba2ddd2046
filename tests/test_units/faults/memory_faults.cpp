#include "tests/test_units/faults/memory_faults.h"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

namespace stride::tests {
namespace {

constexpr int kPieces = 512;
constexpr std::size_t kPiece = std::size_t{1} << 20;

void write_pieces(int file) {
  const std::string piece(kPiece, 'x');
  for (int i = 0; i < kPieces; ++i) {
    if (::write(file, piece.data(), kPiece) != static_cast<ssize_t>(kPiece)) fail("write");
  }
}

/// Through a socket at whose other end it is not received.
void send_file(int socket, int file) {
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof file)] = {};
  char byte = 0;
  iovec content{&byte, 1};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* const head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof file);
  std::memcpy(CMSG_DATA(head), &file, sizeof file);
  if (::sendmsg(socket, &message, MSG_DONTWAIT) < 0) fail("cannot send a file");
}

}  // namespace

void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void fail(const std::string& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

void allocate() {
  std::vector<std::vector<char>> pieces;
  for (;;) pieces.emplace_back(std::size_t{1} << 20, 'x');
}

void allocate_shared() {
  for (int i = 0; i < kPieces; ++i) {
    void* const piece =
        ::mmap(nullptr, kPiece, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (piece == MAP_FAILED) fail("mmap");
    std::memset(piece, 'x', kPiece);
  }
  sleep_for_ever();
}

void write_nameless_file() {
  write_pieces(::memfd_create("pieces", 0));
  sleep_for_ever();
}

void send_nameless_files() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) fail("socketpair");
  const std::string piece(kPiece, 'x');
  for (int i = 0; i < 256; ++i) {
    const int file = ::memfd_create("piece", 0);
    if (::write(file, piece.data(), kPiece) != static_cast<ssize_t>(kPiece)) fail("write");
    send_file(ends[0], file);
    ::close(file);
  }
  sleep_for_ever();
}

void write_temporary_file() {
  const std::string name = std::string(std::getenv("TMPDIR")) + "/pieces";
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT, 0600);
  if (file < 0) fail(name);
  write_pieces(file);
  ::close(file);
  sleep_for_ever();
}

void allocate_in_children() {
  for (int i = 0; i < 8; ++i) {
    if (::fork() != 0) continue;
    const std::string pieces(32 * kPiece, 'x');
    sleep_for_ever();
  }
  sleep_for_ever();
}

void damage_free_memory() {
  constexpr std::size_t kLargest = 1032;  // of the pieces that the C library keeps in lists
  for (std::size_t size = 24; size <= kLargest; size += 16) {
    void* const first = std::malloc(size);
    void* const second = std::malloc(size);
    const volatile auto address = reinterpret_cast<std::uintptr_t>(second);  // unseen by compilers
    std::free(first);
    std::free(second);
    auto* const next_piece = reinterpret_cast<volatile char*>(address);
    for (int i = 0; i < 8; ++i) next_piece[i] = 0x41;
  }
  std::abort();
}

void lock_memory() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long begin = 0, end = 0;
    if (line.find("[heap]") == std::string::npos) continue;
    if (std::sscanf(line.c_str(), "%lx-%lx", &begin, &end) != 2) continue;
    ::mprotect(reinterpret_cast<void*>(begin), end - begin, PROT_NONE);
    return;
  }
}

}  // namespace stride::tests
