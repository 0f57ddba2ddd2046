#include "master/loader/network/frame.h"

#include <cstring>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride::remote;
using stride::tests::error_of;

namespace {

using Bytes = std::vector<std::byte>;

std::string frames_of(const Bytes& message) {
  std::string bytes;
  const std::span<const std::byte> parts[] = {message};
  append_frames(bytes, parts);
  return bytes;
}

Bytes some_bytes(std::size_t count) {
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(17 + i * i);
  return bytes;
}

std::string header(std::uint32_t mark, std::uint32_t size) {
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &mark, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  return bytes;
}

const std::uint32_t kOwnMark = [] {
  std::uint32_t mark = 0;
  std::memcpy(&mark, frames_of(some_bytes(1)).data(), 4);
  return mark;
}();

std::string error_of_bytes(const std::string& bytes) {
  return error_of([&] {
    FrameReader reader;
    reader.put(bytes);
    while (reader.next()) {
    }
  });
}

}  // namespace

TEST_CASE("messages of any length come back from pieces of any size") {
  const std::size_t count = GENERATE(1, 20, kLongestFrame, kLongestFrame + 1, 3'200'003);
  const std::size_t piece = GENERATE(1, 7, 4096, 1 << 22);
  if (count > 10'000 && piece < 100) return;
  const Bytes first = some_bytes(count), second = some_bytes(3);
  const std::string bytes = frames_of(first) + frames_of(second);
  FrameReader reader;
  std::vector<Bytes> found;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    reader.put(std::string_view(bytes).substr(at, piece));
    while (const auto message = reader.next()) {
      found.emplace_back(message->begin(), message->end());
    }
  }
  REQUIRE(found.size() == 2);
  CHECK((found[0] == first));
  CHECK((found[1] == second));
}

TEST_CASE("parts of a message follow each other in frames") {
  const Bytes first = some_bytes(1'600'001), second = some_bytes(10);
  const std::span<const std::byte> parts[] = {first, second};
  std::string bytes;
  append_frames(bytes, parts);
  FrameReader reader;
  reader.put(bytes);
  const auto message = reader.next();
  REQUIRE(message);
  REQUIRE(message->size() == first.size() + second.size());
  CHECK((*message)[first.size() + 1] == second[1]);
}

TEST_CASE("what is no frame is refused, and quoted") {
  CHECK(error_of_bytes("segfault in line 3\nmore") ==
        "what came is no message: 'segfault in line 3'");
  CHECK(error_of_bytes(frames_of(some_bytes(1)) + "printed") ==
        "what came is no message: 'printed'");
  CHECK(error_of_bytes(header(kOwnMark, 0)) == "a part of a message has 0 bytes");
  CHECK(error_of_bytes(header(kOwnMark, kLongestFrame + 8)) ==
        "a part of a message has 1048584 bytes");
}

TEST_CASE("a message without an end is refused before it fills the memory") {
  FrameReader reader;
  const std::string frame =
      header(kOwnMark, kLongestFrame | 0x80000000u) + std::string(kLongestFrame, '\0');
  const std::string error = error_of([&] {
    for (std::size_t i = 0; i <= kLongestMessage / kLongestFrame; ++i) {
      reader.put(frame);
      if (reader.next()) return;
    }
  });
  CHECK(error == "a message has more than 384 MiB");
}
