#include "master/loader/process/output_tail.h"

#include <vector>

#include <catch2/catch.hpp>

using namespace stride::isolation;

TEST_CASE("the last lines are kept, in their order") {
  OutputTail tail;
  CHECK(tail.text().empty());
  tail.add_logged("first\tthing");
  tail.add_printed(std::string(1000, 'x'));
  tail.add_printed("\xef\xef");
  CHECK(tail.text() == "\n  it logged: first thing\n  it printed: " + std::string(199, 'x') +
                           "…\n  it printed: \uFFFD\uFFFD");
  for (std::size_t i = 0; i < OutputTail::kMost; ++i) tail.add_printed(std::to_string(i));
  CHECK(tail.text().find("first") == std::string::npos);
  CHECK(tail.text().find("\n  it printed: 0\n") == 0);
}

TEST_CASE("what is printed becomes lines") {
  PrintedLines lines;
  std::vector<std::string> taken;
  const auto take = [&](std::string_view line) { taken.emplace_back(line); };
  lines.bytes() = "one\n\ntwo\nthr";
  lines.take(take);
  CHECK(taken == std::vector<std::string>{"one", "", "two"});
  lines.bytes() += "ee\nfour";
  lines.take(take);
  CHECK(taken.back() == "three");
  lines.take_rest(take);
  CHECK(taken.back() == "four");
  lines.take_rest(take);
  CHECK(taken.size() == 5);
  lines.bytes() = std::string(100'000, 'x');  // who prints no line end does not fill the memory
  lines.take(take);
  CHECK(taken.back().size() == 100'000);
  CHECK(lines.bytes().empty());
}
