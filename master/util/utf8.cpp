#include "master/util/utf8.h"

#include <algorithm>
#include <cstdint>

namespace stride::core {
namespace {

std::uint8_t byte(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// How many bytes the character at the beginning has; 0 for what is none. The bounds of the second
/// byte leave out what is longer than need be, surrogates, and what is beyond U+10FFFF (The Unicode
/// Standard 15.0, table 3-7).
std::size_t character_size(std::string_view text) {
  const std::uint8_t first = byte(text, 0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t size = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  const std::uint8_t low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const std::uint8_t high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(text, 1) < low || byte(text, 1) > high) return 0;
  for (std::size_t i = 2; i < size; ++i) {
    if ((byte(text, i) & 0xC0) != 0x80) return 0;
  }
  return size;
}

}  // namespace

std::string_view take_character(std::string_view& text) {
  const std::size_t size = character_size(text);
  const std::string_view character = size == 0 ? kReplacement : text.substr(0, size);
  text.remove_prefix(std::max<std::size_t>(size, 1));
  return character;
}

}  // namespace stride::core
