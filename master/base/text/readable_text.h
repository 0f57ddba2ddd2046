// Texts from elsewhere, which may be no UTF-8.
#ifndef STRIDE_MASTER_BASE_TEXT_READABLE_TEXT_H
#define STRIDE_MASTER_BASE_TEXT_READABLE_TEXT_H

#include <cstddef>
#include <string>
#include <string_view>

namespace stride::core {

/// Replaces what is no character.
inline constexpr std::string_view kReplacement = "\uFFFD";

/// Whether the byte is not the first one of a character of UTF-8.
constexpr bool is_within_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// Whether all of its bytes are those of characters of UTF-8.
bool is_utf8(std::string_view text);

/// The text with U+FFFD for each byte that is not of a character of UTF-8.
std::string utf8_text(std::string_view text);

/// The number of characters in a text of UTF-8.
std::size_t character_count(std::string_view text);

/// Takes the first character of UTF-8 off a text that is not empty. A byte that is not of one
/// counts as the character U+FFFD.
std::string_view take_character(std::string_view& text);

/// A text from elsewhere, made fit to be shown in a line: `most` characters at most, the last of
/// which is "…" where there were more; control characters, and those that change the direction of
/// text, are blanks, and each byte that is not of a character of UTF-8 is U+FFFD.
std::string readable_text(std::string_view text, std::size_t most);

/// Whether the text is so already.
inline bool is_readable(std::string_view text) { return readable_text(text, text.size()) == text; }

/// A text made fit for a terminal or a log, where it stays as it is but for what could control the
/// terminal or hide what is written: "\\x1b" for a control character of ASCII other than a line
/// feed or a tab, "\\u202e" for another one and for those that change the direction of text,
/// "\\xff" for a byte that is not of a character of UTF-8.
std::string terminal_text(std::string_view text);

}  // namespace stride::core

#endif
