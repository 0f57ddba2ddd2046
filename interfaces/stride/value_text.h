// Values as text, exactly: what is written reads back as the same value.
#ifndef STRIDE_VALUE_TEXT_H
#define STRIDE_VALUE_TEXT_H

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <stride/value_type.h>

namespace stride {

// ---- Bytes ----

inline constexpr char kHexadecimalDigits[] = "0123456789abcdef";

/// Calls write(char) with two lower-case hexadecimal digits.
template <class Write>
void write_hexadecimal(std::uint8_t byte, Write&& write) {
  write(kHexadecimalDigits[byte >> 4]);
  write(kHexadecimalDigits[byte & 15]);
}

/// Appends two lower-case hexadecimal digits.
inline void append_hexadecimal(std::string& text, std::uint8_t byte) {
  write_hexadecimal(byte, [&](char digit) { text += digit; });
}

/// The value of a hexadecimal digit of either case; -1 for any other character.
constexpr int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Reads two hexadecimal digits for each byte. Returns false for any other text; `bytes` is not
/// usable then.
inline bool parse_hexadecimal(std::string_view text, Binary& bytes) {
  bytes.clear();
  bytes.reserve(text.size() / 2);
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const int high = hexadecimal_digit(text[i]);
    const int low = i + 1 < text.size() ? hexadecimal_digit(text[i + 1]) : -1;
    if (high < 0 || low < 0) return false;
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
  return true;
}

// ---- Characters ----

/// How many of the first `most` bytes of a text in UTF-8 are whole characters.
inline std::size_t whole_characters(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text.size();
  while (most > 0 && (text[most] & 0xC0) == 0x80) --most;
  return most;
}

// ---- Values ----

/// Appends the shortest decimal that reads back as the same number, "inf", "-inf" or "nan"; true or
/// false; two hexadecimal digits for each byte.
template <class T>
void append_value(std::string& text, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    text += value ? "true" : "false";
  } else if constexpr (std::is_same_v<T, Binary>) {
    for (const std::uint8_t byte : value) append_hexadecimal(text, byte);
  } else {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
}

namespace detail {

[[noreturn]] inline void refuse_value(std::string_view text, const char* type,
                                      const char* expected) {
  const std::size_t length = whole_characters(text, 60);
  const std::string shown(text.substr(0, length));
  throw std::invalid_argument("'" + shown + (length < text.size() ? "…" : "") +
                              "' is not a valid " + type + "; expected " + expected);
}

}  // namespace detail

/// Reads a whole text. Throws std::invalid_argument that contains what was expected of a value of
/// the type, which is called `type`.
template <class T>
void parse_value(std::string_view text, T& value, const char* type = type_name<T>()) {
  if constexpr (std::is_same_v<T, std::string>) {
    value.assign(text);
  } else if constexpr (std::is_same_v<T, Binary>) {
    if (parse_hexadecimal(text, value)) return;
    detail::refuse_value(text, type, "two hexadecimal digits for each byte");
  } else if constexpr (std::is_same_v<T, bool>) {
    if (text != "true" && text != "false") detail::refuse_value(text, type, "true or false");
    value = text == "true";
  } else {
    const char* const last = text.data() + text.size();
    const auto [end, mistake] = std::from_chars(text.data(), last, value);
    if (mistake == std::errc() && end == last) return;
    detail::refuse_value(
        text, type,
        std::is_integral_v<T> ? "a whole number within its range" : "a number such as 1.5e-06");
  }
}

}  // namespace stride

#endif
