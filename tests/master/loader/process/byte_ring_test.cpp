#include "master/loader/process/byte_ring.h"

#include <memory>
#include <thread>

#include <catch2/catch.hpp>

using stride::isolation::ByteRing;

TEST_CASE("a ring takes as much as it has room for") {
  const auto ring = std::make_unique<ByteRing>();
  CHECK(ring->is_empty());
  const std::string text(ByteRing::kSize + 10, 'x');
  CHECK(ring->write(text) == ByteRing::kSize);
  CHECK(ring->room() == 0);
  CHECK(ring->write("y") == 0);
  std::string read = "before ";
  ring->read(read);
  CHECK(read == "before " + text.substr(10));
  CHECK(ring->is_empty());
}

TEST_CASE("bytes keep their order around the end of the ring") {
  const auto ring = std::make_unique<ByteRing>();
  std::string written, read;
  for (int i = 0; i < 1000; ++i) {
    const std::string piece(static_cast<std::size_t>(i * 7 % 499), static_cast<char>('a' + i % 26));
    REQUIRE(ring->write(piece) == piece.size());
    written += piece;
    if (i % 3 == 0) ring->read(read);
  }
  ring->read(read);
  CHECK(read == written);
}

TEST_CASE("one thread writes while another reads") {
  const auto ring = std::make_unique<ByteRing>();
  constexpr std::size_t kCount = 3'000'000;
  std::thread writer([&] {
    for (std::size_t i = 0; i < kCount;) {
      const char byte = static_cast<char>(i % 251);
      i += ring->write({&byte, 1});
    }
  });
  std::string read;
  while (read.size() < kCount) ring->read(read);
  writer.join();
  bool is_right = true;
  for (std::size_t i = 0; i < kCount; ++i) is_right &= read[i] == static_cast<char>(i % 251);
  CHECK(is_right);
}
