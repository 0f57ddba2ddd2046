#include "master/base/message_text.h"

#include <algorithm>

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using stride::core::log_text;
using stride::core::message_text;
using stride::core::name_text;

TEST_CASE("a usual message stays as it is") {
  for (const std::string text :
       {"", "a.ssd:7: unit 'ä': it broke\n  hint: mend it", "2 things:\n  one\n\n    two\n"}) {
    CHECK(message_text(text) == text);
    CHECK(log_text(text) == text);
  }
}

TEST_CASE("no line of a message but the first one looks like a message of its own") {
  CHECK(message_text("'a\nstride: error: b'\n c") == "'a\n    stride: error: b'\n     c");
  CHECK(log_text("a\nwarning: b") == "a\n    warning: b");
}

TEST_CASE("NUL ends no message") { CHECK(message_text(std::string("'a\0b'", 5)) == "'a\\x00b'"); }

TEST_CASE("a long word keeps its ends, and is not cut within a character") {
  const std::string text = message_text("unit '" + std::string(100'000, 'a') + "' broke");
  CHECK(text.size() < 500);
  CHECK_THAT(
      text, StartsWith("unit 'aaa") && Contains("more characters) …aaa") && EndsWith("aaa' broke"));
  std::string umlauts = "x";
  for (int i = 0; i < 1000; ++i) umlauts += "ä";
  const std::string short_umlauts = message_text(umlauts);
  CHECK_THAT(short_umlauts, StartsWith("xäää") && EndsWith("äää") && Contains("ä… (8"));
}

TEST_CASE("long lines and many lines are replaced by their number") {
  std::string words;
  for (int i = 0; i < 10'000; ++i) words += "word ";
  CHECK(message_text(words).size() < 2000);
  std::string lines = "first";
  for (int i = 0; i < 10'000; ++i) lines += "\n  line";
  const std::string text = message_text(lines);
  CHECK(std::count(text.begin(), text.end(), '\n') == 100);
  CHECK_THAT(text, EndsWith("\n  … and 9901 more lines"));
}

TEST_CASE("a second call changes nothing") {
  std::string many(5000, 'x');
  for (int i = 0; i < 2000; ++i) many += "\nan unindented line with " + std::string(600, 'y');
  const std::string once = message_text(many);
  CHECK(message_text(once) == once);
}

TEST_CASE("a name is in one line") {
  CHECK(name_text("plain ä") == "plain ä");
  CHECK(name_text("a\nb") == "a\\x0ab");
  CHECK(name_text(std::string("a\0b", 3)) == "a\\x00b");
}
