#include "master/observe/trace/compress.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;
using Catch::Contains;

namespace {

constexpr Duration kTen{10};

std::string compressed(const std::string& text, std::optional<Duration> min_gap = kTen) {
  const TemporaryFolder folder;
  CHECK_FALSE(compress(folder.write("in.vcd", text), folder / "out.vcd", min_gap, CutOff::Refuse)
                  .has_value());
  return content(folder / "out.vcd");
}

std::string compress_error(const std::string& text, std::optional<Duration> min_gap = kTen) {
  const TemporaryFolder folder;
  folder.write("in.vcd", text);
  const std::string message =
      error_of([&] { compress(folder / "in.vcd", folder / "out.vcd", min_gap, CutOff::Refuse); });
  CHECK_FALSE(std::filesystem::exists(folder / "out.vcd"));
  CHECK_FALSE(std::filesystem::exists(folder / "out.vcd.stride-new"));
  return message;
}

const std::string kHeader =
    "$timescale 1 ps $end\n$scope module top $end\n$var integer 64 # advanceTime $end\n"
    "$var wire 1 ! a $end\n$var wire 8 \" b $end\n$upscope $end\n$enddefinitions $end\n";

/// The changes behind the header.
std::string compressed_changes(const std::string& changes) {
  const std::string text = compressed(two_variables(changes));
  CHECK(text.substr(0, kHeader.size()) == kHeader);
  return text.substr(kHeader.size());
}

}  // namespace

TEST_CASE("Gaps longer than the shortest one are shortened to it") {
  CHECK(compressed_changes("#0\n0!\n#10\n1!\n#21\n0!\n#30\n1!\n#1030\n0!\n#1031\n1!\n") ==
        "#0\nb0 #\n0!\n#10\n1!\n#20\nb1 #\n0!\n#29\n1!\n#39\nb1111011111 #\n0!\n#40\n1!\n");
}

TEST_CASE("Stamps at which nothing happens end no gap, but for the last") {
  CHECK(compressed_changes("#0\n0!\n#8\n#16\n#24\n1!\n#32\n#40\n") ==
        "#0\nb0 #\n0!\n#10\nb1110 #\n1!\n#20\nb10100 #\n");
  CHECK(compressed_changes("#5\n#8\n") == "#8\nb0 #\n");
  CHECK(compressed_changes("").empty());
}

TEST_CASE("Changes before the first stamp are at 0; a comment there is nowhere") {
  CHECK(compressed_changes("$comment c $end\n$dumpvars\n0!\n$end\n#100\n1!\n") ==
        "b0 #\n$comment c $end\n$dumpvars\n0!\n$end\n#10\nb1011010 #\n1!\n");
  CHECK(compressed_changes("$comment c $end\n#100\n1!\n") == "$comment c $end\n#100\nb0 #\n1!\n");
  CHECK(compressed_changes("0!\n#0\n") == "b0 #\n0!\n#0\n");
}

TEST_CASE("Dumping off is something that happens") {
  CHECK(compressed_changes("#0\n0!\n#100\n$dumpoff\n$end\n#200\n$dumpon\n$end\n") ==
        "#0\nb0 #\n0!\n#10\nb1011010 #\n$dumpoff\n$end\n#20\nb10110100 #\n$dumpon\n$end\n");
}

TEST_CASE("Without a scope, advanceTime is declared at the end") {
  CHECK(compressed("$timescale 1 ps $end $var wire 1 ! a $end $enddefinitions $end\n#0\n0!\n") ==
        "$timescale 1 ps $end $var wire 1 ! a $end $var integer 64 \" advanceTime $end\n"
        "$enddefinitions $end\n#0\nb0 \"\n0!\n");
}

TEST_CASE("The code of advanceTime is one that no variable has") {
  std::string declarations;
  for (int c = '!'; c <= '~'; ++c) {
    declarations += "$var wire 1 " + std::string(1, static_cast<char>(c)) + " v $end\n";
  }
  CHECK_THAT(compressed(dump(declarations, "")), Contains("$var integer 64 !\" advanceTime $end"));
}

TEST_CASE("The shortest gap is 1 ms, or a tick where that is longer") {
  const TemporaryFolder folder;
  const auto ticks = [&](const std::string& timescale, std::optional<Duration> min_gap) {
    const Reader reader(
        folder.write("x.vcd", "$timescale " + timescale + " $end $enddefinitions $end\n"));
    return min_gap_ticks(reader, min_gap);
  };
  CHECK(ticks("1 ps", {}) == 1'000'000'000);
  CHECK(ticks("100 us", {}) == 10);
  CHECK(ticks("10 ms", {}) == 1);
  CHECK(ticks("1 ns", Duration(5'999)) == 5);
  CHECK_THROWS_WITH(
      ticks("1 ns", Duration(999)),
      Contains("x.vcd: a gap of 0.000000000999 s is shorter than 1 ns, the time scale") &&
          Contains("the shortest is --min-gap 0.000000001"));
  CHECK_THROWS_AS(ticks("1 ps", Duration(0)), core::Error);
}

TEST_CASE("A trace that has advanceTime is not compressed") {
  CHECK_THAT(compress_error(skipping("#0\n0!\n")),
             Contains("in.vcd: the trace has a variable advanceTime") &&
                 Contains("'stride trace expand'"));
}

TEST_CASE("What is wrong leaves nothing") {
  CHECK_THAT(compress_error(two_variables("#0\n0!\n#100\n1")),
             Contains("in.vcd:10: the file is cut off: it ends within '1'"));
  CHECK_THAT(compress_error(two_variables("#0\n0!\n"), Duration(0)),
             Contains("a gap of 0 s is shorter"));
}

TEST_CASE("Of a trace that was cut off, all but the last instant is there if that is accepted") {
  const TemporaryFolder folder;
  folder.write("in.vcd", two_variables("#0\n0!\n#100\n1!\n#300\n0!\nb1"));
  CHECK(compress(folder / "in.vcd", folder / "out.vcd", kTen, CutOff::Accept) == 13);
  CHECK(content(folder / "out.vcd") == kHeader + "#0\nb0 #\n0!\n#10\nb1011010 #\n1!\n");
}
