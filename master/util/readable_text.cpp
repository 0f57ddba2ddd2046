#include "master/util/readable_text.h"

#include <cstdint>

#include <utf8.h>

namespace stride::core {
namespace {

constexpr std::string_view kEllipsis = "…";

/// C0 and C1, DEL, and the separators of lines and paragraphs.
bool is_control(std::string_view character) {
  const auto first = static_cast<std::uint8_t>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  if (character.size() == 2) return character >= "\u0080" && character < "\u00A0";
  return character == "\u2028" || character == "\u2029";
}

}  // namespace

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

}  // namespace stride::core
