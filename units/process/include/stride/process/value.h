// Values as text, exactly: what is written reads back as the same value.
#ifndef STRIDE_PROCESS_VALUE_H
#define STRIDE_PROCESS_VALUE_H

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace stride::process {

using Binary = std::vector<std::uint8_t>;

/// The name that FMI has for a type: float, double, the integers of C++, bool, std::string, Binary.
template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, float>) {
    return "Float32";
  } else if constexpr (std::is_same_v<T, double>) {
    return "Float64";
  } else if constexpr (std::is_same_v<T, bool>) {
    return "Boolean";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "String";
  } else if constexpr (std::is_same_v<T, Binary>) {
    return "Binary";
  } else {
    static_assert(std::is_integral_v<T>, "this type has no counterpart in the protocol");
    constexpr const char* kSigned[] = {"Int8", "Int16", "Int32", "Int64"};
    constexpr const char* kUnsigned[] = {"UInt8", "UInt16", "UInt32", "UInt64"};
    constexpr int kLog2 = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return std::is_signed_v<T> ? kSigned[kLog2] : kUnsigned[kLog2];
  }
}

/// Appends the shortest decimal that reads back as the same number, "inf", "-inf" or "nan"; true or
/// false; two hexadecimal digits for each byte. (Texts are escaped by TagWriter.)
template <class T>
void append_value(std::string& text, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    text += value ? "true" : "false";
  } else if constexpr (std::is_same_v<T, Binary>) {
    constexpr char kDigits[] = "0123456789abcdef";
    for (const std::uint8_t byte : value) {
      text += kDigits[byte >> 4];
      text += kDigits[byte & 15];
    }
  } else {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
}

namespace detail {

[[noreturn]] inline void refuse(std::string_view text, const char* type, const char* expected) {
  constexpr std::size_t kMost = 60;
  const std::string shown(text.substr(0, kMost));
  throw std::invalid_argument("'" + shown + (text.size() > kMost ? "…" : "") + "' is no " + type +
                              "; expected " + expected);
}

inline int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

inline void parse_binary(std::string_view text, Binary& bytes) {
  bytes.clear();
  bytes.reserve(text.size() / 2);
  for (std::size_t i = 0; i < text.size(); i += 2) {
    const int high = hexadecimal_digit(text[i]);
    const int low = i + 1 < text.size() ? hexadecimal_digit(text[i + 1]) : -1;
    if (high < 0 || low < 0) refuse(text, "Binary", "two hexadecimal digits for each byte");
    bytes.push_back(static_cast<std::uint8_t>(16 * high + low));
  }
}

}  // namespace detail

/// Reads a whole text. Throws std::invalid_argument that says what was expected.
template <class T>
void parse_value(std::string_view text, T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    value.assign(text);
  } else if constexpr (std::is_same_v<T, Binary>) {
    detail::parse_binary(text, value);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (text != "true" && text != "false") detail::refuse(text, "Boolean", "true or false");
    value = text == "true";
  } else {
    const char* const last = text.data() + text.size();
    const auto [end, mistake] = std::from_chars(text.data(), last, value);
    if (mistake == std::errc() && end == last) return;
    detail::refuse(
        text, type_name<T>(),
        std::is_integral_v<T> ? "a whole number within its range" : "a number such as 1.5e-06");
  }
}

/// Whether two values are the same, so that one of them need not be told: a zero has its sign, and
/// one NaN is as good as the other where their bits are the same.
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
