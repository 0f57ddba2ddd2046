#include "units/player/csv.h"

#include <catch2/catch.hpp>

using player::CsvRows;

namespace {

std::vector<std::string> only_row(const std::string& text) {
  CsvRows rows(text, "x.csv");
  REQUIRE(rows.next());
  const auto fields = rows.fields();
  CHECK(rows.at_end());
  CHECK(!rows.next());
  return fields;
}

std::string csv_mistake_in(const std::string& text) {
  CsvRows rows(text, "x.csv");
  try {
    while (rows.next()) {
    }
  } catch (const std::runtime_error& mistake) {
    return mistake.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a row is split at its commas") {
  CHECK(only_row("a,b,c\n") == std::vector<std::string>{"a", "b", "c"});
  CHECK(only_row("\n") == std::vector<std::string>{""});
  CHECK(only_row(",,\n") == std::vector<std::string>{"", "", ""});
}

TEST_CASE("a quoted field holds what separates elsewhere") {
  CHECK(only_row("1,\"a,b\",2\n") == std::vector<std::string>{"1", "a,b", "2"});
  CHECK(only_row("\"say \"\"so\"\"\",\"\"\n") == std::vector<std::string>{"say \"so\"", ""});
  CHECK(only_row("\"two\nlines\"\n") == std::vector<std::string>{"two\nlines"});
}

TEST_CASE("a row may end as on Windows, and the file begin with a byte order mark") {
  CHECK(only_row("\xef\xbb\xbf"
                 "a,b\r\n") == std::vector<std::string>{"a", "b"});
  CHECK(only_row("a,\"b\r\nc\"\r\n") == std::vector<std::string>{"a", "b\r\nc"});
  CHECK(only_row("a\rb,\r\n") == std::vector<std::string>{"a\rb", ""});
  CHECK(only_row("\r\n") == std::vector<std::string>{""});
}

TEST_CASE("lines are counted, also within quotation marks") {
  const std::string text = "a\n\"b\nb\nb\",c\nd\n";
  CsvRows rows(text, "x.csv");
  for (const int line : {1, 2, 5}) {
    REQUIRE(rows.next());
    CHECK(rows.line() == line);
  }
}

TEST_CASE("a row without its end, and misplaced quotation marks, are reported with their line") {
  CHECK(csv_mistake_in("a,b\nc") == "x.csv:2: the line is cut off");
  CHECK(csv_mistake_in(std::string("a\n0\0,b\n", 7)) == "x.csv:2: a field has a NUL character");
  CHECK(csv_mistake_in("a,b\nc,") == "x.csv:2: the line is cut off");
  CHECK(csv_mistake_in("a\n\"b\nc") == "x.csv:2: the line is cut off within a quoted text");
  CHECK_THAT(csv_mistake_in("\"a\"b\n"), Catch::Contains("x.csv:1: behind a quoted text"));
  CHECK_THAT(csv_mistake_in("a\"b\"\n"), Catch::Contains("x.csv:1: the field 'a\"b\"'"));
  CHECK(csv_mistake_in("") == "");
}
