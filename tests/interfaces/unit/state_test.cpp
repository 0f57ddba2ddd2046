#include <cstring>
#include <new>

#include <catch2/catch.hpp>

#include <stride/unit/state.h>

using stride::StateReader;
using stride::StateWriter;

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Padded {
  bool one;
  double other;
};

template <class T>
Bytes written(const T& value) {
  Bytes bytes;
  StateWriter(bytes).write(value);
  return bytes;
}

template <class T>
T read(const Bytes& bytes) {
  T value{};
  StateReader reader(bytes.data(), bytes.size());
  reader.read(value);
  CHECK(reader.left() == 0);
  return value;
}

/// In memory that held other bytes before.
Bytes written_over(int pattern) {
  alignas(Padded) unsigned char memory[sizeof(Padded)];
  std::memset(memory, pattern, sizeof memory);
  auto* const padded = new (memory) Padded;
  padded->one = true;
  padded->other = 0.5;
  return written(*padded);
}

}  // namespace

TEST_CASE("what was written is read back") {
  CHECK(read<double>(written(0.1)) == 0.1);
  CHECK(read<std::string>(written(std::string("words"))) == "words");
  const std::vector<std::string> words{"two", "", "words"};
  CHECK(read<std::vector<std::string>>(written(words)) == words);
  const std::deque<std::optional<int>> numbers{3, std::nullopt, 5};
  CHECK(read<std::deque<std::optional<int>>>(written(numbers)) == numbers);
}

TEST_CASE("padding and an empty optional are the same bytes, whatever was there before") {
#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
  CHECK(written_over(0x00) == written_over(0xFF));
#endif
#endif
  CHECK(read<Padded>(written_over(0xFF)).other == 0.5);
  std::optional<double> empty = 0.5;
  empty.reset();
  CHECK(written(empty) == written(std::optional<double>()));
  CHECK(written(empty).size() == 1);
}

TEST_CASE("a sequence that claims to be longer than its bytes is refused before there is memory") {
  Bytes bytes;
  StateWriter writer(bytes);
  writer.write(std::uint64_t{3});
  writer.write(std::uint64_t{0});
  StateReader reader(bytes.data(), bytes.size());
  std::vector<double> values;
  CHECK_THROWS_WITH(reader.read(values), "the saved state ends too early");
  CHECK(values.capacity() == 0);
}
