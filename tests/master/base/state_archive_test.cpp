#include "master/base/state_archive.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/time.h>

using stride::Duration;
using stride::Time;
using stride::core::BadState;
using stride::core::StateArchive;

namespace {

enum class Colour : std::uint8_t { Red, Green };

struct Part {
  bool is_on = false;
  double level = 0;
  void persist(StateArchive& state) {
    state.value(is_on);
    state.value(level);
  }
};

struct Whole {
  std::int64_t count = 0;
  Time time{};
  std::optional<Duration> lag{};
  std::string name{};
  Colour colour = Colour::Red;
  std::vector<double> history{};
  std::vector<Part> parts{};
  Part fixed[2]{};

  void persist(StateArchive& state) {
    state.mark("whole");
    state.value(count);
    state.value(time);
    state.value(lag);
    state.value(name);
    state.value(colour, Colour::Green);
    state.values(history);
    state.sequence(parts, [&](Part& part) { part.persist(state); });
    state.fixed(fixed, [&](Part& part) { part.persist(state); });
  }
};

Whole example() {
  return {-3,
          Time(Duration(17)),
          Duration(5),
          std::string("a\0b", 3),
          Colour::Green,
          {1, -0.0, std::numeric_limits<double>::infinity()},
          {{true, 2}, {false, 3}},
          {{true, 4}, {false, 5}}};
}

std::vector<std::byte> written(Whole whole) {
  StateArchive state;
  whole.persist(state);
  return state.bytes();
}

}  // namespace

TEST_CASE("what was written is read back") {
  const std::vector<std::byte> bytes = written(example());
  Whole read;
  StateArchive state(bytes);
  CHECK(state.is_reading());
  read.persist(state);
  state.end();
  CHECK(read.count == -3);
  CHECK(read.time == Time(Duration(17)));
  CHECK(read.lag == Duration(5));
  CHECK(read.name == std::string("a\0b", 3));
  CHECK(read.colour == Colour::Green);
  CHECK(read.history == std::vector<double>{1, 0, std::numeric_limits<double>::infinity()});
  CHECK(read.parts[1].level == 3);
  CHECK(read.fixed[1].level == 5);
  CHECK(written(read) == bytes);
}

TEST_CASE("a state that is cut off anywhere is bad") {
  const std::vector<std::byte> bytes = written(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Whole read;
    StateArchive state{std::span(bytes).first(size)};
    CHECK_THROWS_AS(read.persist(state), BadState);
  }
}

TEST_CASE("bytes that are left over, and those of something else, are bad") {
  std::vector<std::byte> bytes = written(example());
  bytes.push_back(std::byte{0});
  Whole read;
  StateArchive longer(bytes);
  read.persist(longer);
  CHECK_THROWS_WITH(longer.end(), Catch::Contains("1 bytes are left over"));

  StateArchive other(bytes);
  CHECK_THROWS_WITH(other.mark("half"), Catch::Contains("'half' was expected"));
}

TEST_CASE("sizes beyond the bytes that are there allocate nothing") {
  StateArchive state;
  std::uint64_t size = std::numeric_limits<std::uint64_t>::max();
  state.value(size);
  StateArchive read(state.bytes());
  std::vector<double> values;
  CHECK_THROWS_AS(read.values(values), BadState);
}

TEST_CASE("Booleans, items and numbers of elements that cannot be are bad") {
  const std::vector<std::byte> two{std::byte{2}};
  bool truth = false;
  StateArchive boolean(two);
  CHECK_THROWS_AS(boolean.value(truth), BadState);
  Colour colour = Colour::Red;
  StateArchive item(two);
  CHECK_THROWS_AS(item.value(colour, Colour::Green), BadState);

  StateArchive state;
  std::vector<int> three(3);
  state.fixed(three);
  std::vector<int> four(4);
  StateArchive read(state.bytes());
  CHECK_THROWS_WITH(read.fixed(four), Catch::Contains("3 elements where there should be 4"));
}

TEST_CASE("keys may be others than those of the reader, but ascend and exist") {
  const auto read = [](std::vector<std::uint64_t> written, std::uint64_t end) {
    StateArchive state;
    state.values(written);
    StateArchive reader(state.bytes());
    std::vector<std::uint64_t> keys{1, 2};
    reader.keys(keys, end);
    return keys;
  };
  CHECK(read({0, 3, 7}, 8) == std::vector<std::uint64_t>{0, 3, 7});
  CHECK(read({}, 0).empty());
  CHECK_THROWS_WITH(read({0, 3, 7}, 7), Catch::Contains("a key that does not exist"));
  CHECK_THROWS_WITH(read({3, 0}, 8), Catch::Contains("do not ascend"));
  CHECK_THROWS_WITH(read({3, 3}, 8), Catch::Contains("do not ascend"));
}
