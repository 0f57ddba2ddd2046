#include "master/loader/network/frame.h"

#include <cstring>
#include <numeric>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride::remote;
using stride::tests::error_of;

namespace {

using Words = std::vector<std::uint64_t>;

std::string frames_of(const Words& words) {
  std::string bytes;
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(words))};
  append_frames(bytes, parts);
  return bytes;
}

Words some_words(std::size_t count) {
  Words words(count);
  std::iota(words.begin(), words.end(), 17);
  return words;
}

std::string header(std::uint32_t mark, std::uint32_t size) {
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &mark, 4);
  std::memcpy(bytes.data() + 4, &size, 4);
  return bytes;
}

const std::uint32_t kOwnMark = [] {
  std::uint32_t mark = 0;
  std::memcpy(&mark, frames_of({1}).data(), 4);
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
  const std::size_t count = GENERATE(1, 20, kLongestFrame / 8, kLongestFrame / 8 + 1, 400'000);
  const std::size_t piece = GENERATE(1, 7, 4096, 1 << 22);
  if (count > 1000 && piece < 100) return;
  const Words first = some_words(count), second = some_words(3);
  const std::string bytes = frames_of(first) + frames_of(second);
  FrameReader reader;
  std::vector<Words> found;
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
  const Words first = some_words(200'000), second = some_words(10);
  const std::span<const std::byte> parts[] = {std::as_bytes(std::span(first)),
                                              std::as_bytes(std::span(second))};
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
  CHECK(error_of_bytes(frames_of({1}) + "printed") == "what came is no message: 'printed'");
  CHECK(error_of_bytes(header(kOwnMark, 0)) == "a part of a message has 0 bytes");
  CHECK(error_of_bytes(header(kOwnMark, 9)) == "a part of a message has 9 bytes");
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
