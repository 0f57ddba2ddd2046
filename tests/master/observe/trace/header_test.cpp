#include "master/observe/trace/header.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride::trace;
using Catch::Contains;

TEST_CASE("Codes are numbered as they come, and equal ones are one") {
  CodeTable codes;
  CHECK(codes.add("!") == 0);
  CHECK(codes.add("aaaaa") == 1);
  CHECK(codes.add("a code of any length") == 2);
  CHECK(codes.add("!") == 0);
  CHECK(codes.add("a code of any length") == 2);
  CHECK(codes.size() == 3);
  CHECK(codes.find("aaaaa") == 1U);
  CHECK(codes.find("a code of any length") == 2U);
  for (const char* unknown : {"", "a", "aaaa", "aaaaaa", "a code of any", "\""}) {
    CHECK_FALSE(codes.find(unknown).has_value());
  }
}

TEST_CASE(
    "Tens of thousands of codes are found again, those of eight and of nine characters, too") {
  CodeTable codes;
  const auto code = [](std::uint32_t i) { return std::string(i % 10, '~') + std::to_string(i); };
  for (std::uint32_t i = 0; i < 50'000; ++i) REQUIRE(codes.add(code(i)) == i);
  for (std::uint32_t i = 0; i < 50'000; ++i) REQUIRE(codes.find(code(i)) == i);
  CHECK_FALSE(codes.find("50000").has_value());
  CHECK_FALSE(codes.find("~~~~~~~~~50009").has_value());
}

namespace {

struct Read {
  Header header;
  std::string rest;  ///< the first word behind the header
};

Read read_head(const std::string& text) {
  const TemporaryFolder folder;
  Words words(folder.write("x.vcd", text));
  Header header = read_header(words);
  std::string rest(words.next());
  return {std::move(header), std::move(rest)};
}

std::string header_error(const std::string& text) {
  return error_of([&] { read_head(text); });
}

/// An error in the declarations, which begin in line 2.
std::string header_declaration_error(const std::string& declarations) {
  return header_error("$timescale 1 ps $end\n" + declarations + "$enddefinitions $end\n");
}

}  // namespace

TEST_CASE("A header is kept as it is, and its declarations are found in it") {
  const std::string text =
      "$date\n   today\n$end\n$version none $end $timescale\n\t10ns\n$end\n"
      "$comment $var is explained $scope $end\n"
      "$scope module top $end\n$var wire 1 ! a $end\n$scope task $unit $end\n"
      "$var\n  wire 8\n  aaaab level [7:0]\n$end $var real 64 $x temperature[3] $end\n"
      "$upscope $end\n$upscope $end\n$attrbegin misc 02 $end\n$var event 1 ! again $end\n"
      "$enddefinitions\n  $end";
  const auto [header, rest] = read_head(text + "\n#0\n");
  CHECK(header.text == text);
  CHECK(rest == "#0");
  CHECK(header.timescale.text() == "10 ns");
  REQUIRE(header.declarations.size() == 4);
  const auto check = [&](std::size_t i, const char* type, std::uint32_t width, std::uint32_t code,
                         const char* name, int line) {
    const Declaration& declaration = header.declarations[i];
    CHECK(header.at(declaration.type) == type);
    CHECK(declaration.width == width);
    CHECK(declaration.code == code);
    CHECK(header.at(declaration.name) == name);
    CHECK(declaration.line == line);
  };
  check(0, "wire", 1, 0, "a", 9);
  check(1, "wire", 8, 1, "level", 11);
  check(2, "real", 64, 2, "temperature", 14);
  check(3, "event", 1, 0, "again", 18);
  CHECK(header.at(header.declarations[0].section) == "$var wire 1 ! a $end");
  CHECK(header.at({0, header.first_scope_end}).substr(header.first_scope_end - 23) ==
        "\n$scope module top $end");
  CHECK(text.substr(header.end_definitions) == "$enddefinitions\n  $end");
}

TEST_CASE("What is not a header is reported with its line") {
  CHECK_THAT(header_error(""), Contains("x.vcd:1: the file ends before $enddefinitions"));
  CHECK_THAT(header_error("$timescale 1 ps $end\n"), Contains("x.vcd:2: the file ends before"));
  CHECK_THAT(header_error("\x1f\x8b\x08 gzip"), Contains("x.vcd:1: '\\x1f\\x8b\\x08' is where") &&
                                                    Contains("gunzip") && Contains("fst2vcd"));
  CHECK_THAT(header_error("$version 1 $end\n#0\n"),
             Contains("x.vcd:2: '#0' is where") && !Contains("hint"));
  CHECK_THAT(header_error("$version 1 $end $end\n"), Contains("x.vcd:1: '$end' is where"));
  CHECK_THAT(header_error("$enddefinitions $end\n"),
             Contains("x.vcd:1: there is no $timescale") && Contains("$timescale 1 ns $end"));
  CHECK_THAT(header_error("$timescale 2 ps $end\n$enddefinitions $end\n"),
             Contains("x.vcd:1: '2ps' is not a time scale; expected 1, 10 or 100 of"));
  CHECK_THAT(header_error("$timescale $end\n$enddefinitions $end\n"),
             Contains("'' is not a time scale"));
  CHECK_THAT(header_declaration_error("$timescale 1 ps $end\n"),
             Contains("x.vcd:2: there is a second $timescale"));
  CHECK_THAT(header_declaration_error("$upscope $end\n"),
             Contains("x.vcd:2: $upscope closes no scope"));
}

TEST_CASE("A section that does not end is reported with the line where it begins") {
  const std::string begin = "$timescale 1 ps $end\n";
  CHECK_THAT(header_error(begin + "$var wire 1"),
             Contains("x.vcd:2: the file ends within the $var of line 2; it was cut off"));
  CHECK_THAT(header_error(begin + "$comment\n no end\n\n"),
             Contains("the file ends within the $comment of line 2"));
  CHECK_THAT(header_error(begin + "$var wire 1 ! a\n$var wire 1 \" b $end\n"),
             Contains("x.vcd:3: the $var of line 2 has no $end before '$var'"));
  CHECK_THAT(header_error(begin + "$scope module a\n$enddefinitions $end\n"),
             Contains("x.vcd:3: the $scope of line 2 has no $end before '$enddefinitions'"));
  CHECK_THAT(header_error(begin + "$comment " + std::string(Words::kLongest / 2, ' ') + "a " +
                          std::string(Words::kLongest / 2, ' ') + "b\n"),
             Contains("the $comment of line 2 has no $end"));
}

TEST_CASE("A variable has a type, a width, a code and a name") {
  CHECK_THAT(header_declaration_error("$var wire 1 ! $end\n"),
             Contains("x.vcd:2: a $var has a type, a width, a code and a name, this one has only "
                      "3 of them"));
  CHECK_THAT(header_declaration_error("$var wire many ! a $end\n"),
             Contains("x.vcd:2: 'many' is not a width in bits"));
  CHECK_THAT(header_declaration_error("$var wire -1 ! a $end\n"),
             Contains("'-1' is not a width in bits"));
  CHECK_THAT(header_declaration_error("$var wire 1 \xc3\xa4 a $end\n"),
             Contains("x.vcd:2: '\\xc3\\xa4' is not an identifier code"));
}
