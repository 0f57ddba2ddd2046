#include "master/base/text/readable_text.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <utf8.h>

namespace stride::core {
namespace {

constexpr std::string_view kEllipsis = "…";

bool is_between(char32_t first, char32_t code, char32_t last) {
  return first <= code && code <= last;
}

/// C0 and C1, DEL, the separators of lines and paragraphs, and what changes the direction of text
/// (Bidi_Control of Unicode).
bool is_control(std::string_view character) {
  const char32_t code = utf8::unchecked::peek_next(character.begin());
  return code < 0x20 || is_between(0x7F, code, 0x9F) || code == 0x061C || code == 0x200E ||
         code == 0x200F || is_between(0x2028, code, 0x202E) || is_between(0x2066, code, 0x2069);
}

void append_escaped(std::string& text, std::string_view character) {
  const char32_t code = utf8::unchecked::peek_next(character.begin());
  const auto number = static_cast<std::uint32_t>(code);
  text += code < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
}

}  // namespace

bool is_utf8(std::string_view text) { return utf8::is_valid(text.begin(), text.end()); }

std::string utf8_text(std::string_view text) {
  std::string valid;
  while (!text.empty()) valid += take_character(text);
  return valid;
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return !is_within_character(byte); }));
}

std::string_view take_character(std::string_view& text) {
  constexpr std::size_t kLongest = 4;
  const std::string_view head = text.substr(0, kLongest);
  if (utf8::find_invalid(head.begin(), head.end()) == head.begin()) {
    text.remove_prefix(1);
    return kReplacement;
  }
  const auto* end = text.begin();
  utf8::unchecked::next(end);
  const std::string_view character(text.begin(), end);
  text.remove_prefix(character.size());
  return character;
}

std::string readable_text(std::string_view text, std::size_t most) {
  std::string readable;
  std::size_t last = 0;  // where the last character that may stay begins
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == most) return readable.substr(0, last).append(most == 0 ? "" : kEllipsis);
    const std::string_view character = take_character(text);
    last = readable.size();
    readable += is_control(character) ? " " : character;
  }
  return readable;
}

std::string terminal_text(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const char first = text.front();
    const std::string_view character = take_character(text);
    if (character.data() == kReplacement.data()) {  // of a byte
      safe += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(first));
    } else if (first != '\n' && first != '\t' && is_control(character)) {
      append_escaped(safe, character);
    } else {
      safe += character;
    }
  }
  return safe;
}

}  // namespace stride::core
