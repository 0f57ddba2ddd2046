#include "master/observe/trace/words.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride::trace;
using Catch::Contains;

namespace {

std::vector<std::string> all(const std::filesystem::path& file) {
  Words words(file);
  std::vector<std::string> found;
  for (auto word = words.next(); !word.empty(); word = words.next()) found.emplace_back(word);
  return found;
}

}  // namespace

TEST_CASE("Blanks of all kinds part words") {
  const TemporaryFolder folder;
  CHECK(all(folder.write("x", " one\ttwo\r\nthree\v\ffour \n")) ==
        std::vector<std::string>{"one", "two", "three", "four"});
  CHECK(all(folder.write("x", "one")) == std::vector<std::string>{"one"});
  CHECK(all(folder.write("x", " \n ")).empty());
  CHECK(all(folder.write("x", "")).empty());
}

TEST_CASE("A NUL is not a blank: it is what a crashed machine leaves at the end of a file") {
  const TemporaryFolder folder;
  Words words(folder.write("x", std::string("a\0\0\n", 4)));
  CHECK(words.next() == std::string_view("a\0\0", 3));
  CHECK(Words::shown(std::string_view("a\0\0", 3)) == "a\\x00\\x00");
}

TEST_CASE("Words know their lines, and whether the file ends with them") {
  const TemporaryFolder folder;
  Words words(folder.write("x", "one\n\n two three\nfour"));
  const auto next = [&](std::string_view text, int line, bool is_at_end) {
    CHECK(words.next() == text);
    CHECK(words.line() == line);
    CHECK(words.is_at_end() == is_at_end);
  };
  next("one", 1, false);
  next("two", 3, false);
  next("three", 3, false);
  next("four", 4, true);
  next("", 4, true);
  CHECK(words.bytes_read() == 20);
}

TEST_CASE("Words at all places of the buffer are whole, with their lines") {
  const TemporaryFolder folder;
  std::string text;
  std::vector<std::string> expected;
  for (int i = 0; text.size() < 1'500'000; ++i) {
    expected.push_back(std::string(static_cast<std::size_t>(i % 1000), 'x') + std::to_string(i));
    text += expected.back() + (i % 7 == 0 ? " \n" : "\n");
  }
  Words words(folder.write("x", text));
  std::string recorded;
  words.record_into(&recorded);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(words.next() == expected[i]);
    REQUIRE(words.line() == static_cast<std::int64_t>(i) + 1);
  }
  CHECK(words.next().empty());
  CHECK(recorded == text);
}

TEST_CASE("A word may be as long as any vector, but not without end") {
  const TemporaryFolder folder;
  const std::string vector(3'000'000, '1');
  Words words(folder.write("x", "a " + vector + " b\n"));
  words.next();
  CHECK(words.next() == vector);
  CHECK(words.next() == "b");
  Words endless(folder.write("x", "\n" + std::string(Words::kLongest + 1, 'z')));
  CHECK_THROWS_WITH(endless.next(), Contains("x:2: 'zzzz") && Contains("…' is longer than any"));
}

TEST_CASE("What cannot be read is named") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(Words(folder / "none.vcd"),
                    Contains("none.vcd: cannot open the file: No such file"));
  Words words(folder / "");
  CHECK_THROWS_WITH(words.next(), Contains("cannot read the file: Is a directory"));
}
