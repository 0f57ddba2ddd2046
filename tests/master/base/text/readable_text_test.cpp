#include "master/base/text/readable_text.h"

#include <random>

#include <catch2/catch.hpp>

using stride::core::is_readable;
using stride::core::readable_text;
using stride::core::terminal_text;

TEST_CASE("a text of whole characters stays what it is") {
  for (const char* text : {"", "set_led 1", "21.49 °C", "\u00A0\u07FF\u0800\uD7FF\uE000\uFFFD",
                           "\U00010000\U0010FFFF"}) {
    CHECK(readable_text(text, 100) == text);
    CHECK(is_readable(text));
  }
}

TEST_CASE("control characters become blanks, each byte that is of no character U+FFFD") {
  const std::pair<std::string, std::string> cases[] = {
      {"a\nb\tc\x7F", "a b c "},
      {std::string("a\0b", 3), "a b"},
      {"\u0085\u2028\u2029", "   "},
      {"a\u202Eb\u2066c\u200F\u061C", "a b c  "},
      {"a\xFF", "a\uFFFD"},
      {"\xC3", "\uFFFD"},                                // broken off
      {"\x80x", "\uFFFDx"},                              // in the middle of one
      {"\xC0\xAF", "\uFFFD\uFFFD"},                      // longer than need be
      {"\xE0\x80\xAF", "\uFFFD\uFFFD\uFFFD"},            // likewise
      {"\xED\xA0\x80", "\uFFFD\uFFFD\uFFFD"},            // a surrogate
      {"\xF4\x90\x80\x80", "\uFFFD\uFFFD\uFFFD\uFFFD"},  // beyond the last
      {"\xE2\x82z", "\uFFFD\uFFFDz"},
  };
  for (const auto& [text, expected] : cases) {
    CAPTURE(expected);
    CHECK(readable_text(text, 100) == expected);
    CHECK_FALSE(is_readable(text));
  }
}

TEST_CASE("a longer text ends in an ellipsis, which counts") {
  CHECK(readable_text("abcde", 5) == "abcde");
  CHECK(readable_text("abcdef", 5) == "abcd…");
  CHECK(readable_text("°°°", 2) == "°…");
  CHECK(readable_text("abc", 1) == "…");
  CHECK(readable_text("abc", 0) == "");
}

TEST_CASE("what comes out is readable, whatever goes in") {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string text(random() % 20, '\0');
    for (char& c : text)
      c = static_cast<char>(random() % 8 == 0 ? random() : 0x80 + random() % 128);
    const std::size_t most = random() % 24;
    const std::string readable = readable_text(text, most);
    CHECK(is_readable(readable));
    CHECK(readable_text(readable, most) == readable);
  }
}

TEST_CASE("a text for a terminal stays as it is, but for what could control it") {
  const std::pair<std::string, std::string> cases[] = {
      {"", ""},
      {"a\tb\nc °", "a\tb\nc °"},
      {"\x1b[2J", "\\x1b[2J"},
      {std::string("a\0b", 3), "a\\x00b"},
      {"10 %\r 99 %\b\x7f", "10 %\\x0d 99 %\\x08\\x7f"},
      {"\u0080\u009b31m\u009f\u00a0", "\\u0080\\u009b31m\\u009f\u00a0"},
      {"\x9b\x31m", "\\x9b1m"},  // C1 in Latin-1
      {"\u202a\u202b\u202c\u202d\u202e", "\\u202a\\u202b\\u202c\\u202d\\u202e"},
      {"\u2066\u2067\u2068\u2069", "\\u2066\\u2067\\u2068\\u2069"},
      {"\u200e\u200f\u061c\u2028", "\\u200e\\u200f\\u061c\\u2028"},
      {"\u2065\u206a\uFFFD", "\u2065\u206a\uFFFD"},
      {"\xc3(", "\\xc3("},
      {"\xef\xbf", "\\xef\\xbf"},
  };
  for (const auto& [text, expected] : cases) {
    CAPTURE(expected);
    CHECK(terminal_text(text) == expected);
    CHECK(terminal_text(expected) == expected);
  }
}
