// Values and texts of the protocol. Values are written and read as <stride/value_text.h> defines;
// texts are escaped by TagWriter.
#ifndef STRIDE_PROCESS_VALUE_H
#define STRIDE_PROCESS_VALUE_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include <stride/value_text.h>

namespace stride::process {

using stride::append_value;
using stride::Binary;
using stride::parse_value;
using stride::type_name;

/// Whether two values are the same, so that only one of them has to be sent: a zero has its sign,
/// and two NaNs are the same where their bits are.
template <class T>
bool is_same(const T& one, const T& other) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::memcmp(&one, &other, sizeof one) == 0;
  } else {
    return one == other;
  }
}

// ---- Characters ----

/// The characters that XML 1.0 has.
constexpr bool is_xml_character(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code < 0xD800 || (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code < 0x110000);
}

inline void append_utf8(std::string& text, std::uint32_t code) {
  const auto continued = [&](int shift) {
    text += static_cast<char>(0x80 | (code >> shift & 0x3F));
  };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | code >> 6);
    continued(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0 | code >> 12);
    continued(6);
    continued(0);
  } else {
    text += static_cast<char>(0xF0 | code >> 18);
    continued(12);
    continued(6);
    continued(0);
  }
}

namespace detail {

/// How many bytes the character at the beginning of the text has; 0 if there is none of XML.
inline std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return is_xml_character(first) ? 1 : 0;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 0;
  if (size == 0 || size > text.size()) return 0;
  std::uint32_t code = first & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  return code >= kLeast[size] && is_xml_character(code) ? size : 0;
}

}  // namespace detail

/// Where a text stops being one of characters of XML in UTF-8; npos if it does not.
inline std::size_t first_unfit(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = detail::character_size(text.substr(i));
    if (size == 0) return i;
    i += size;
  }
  return std::string_view::npos;
}

}  // namespace stride::process

#endif
