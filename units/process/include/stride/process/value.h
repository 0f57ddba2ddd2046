// Values and texts of the protocol. Values are written and read as <stride/value_text.h> defines,
// the elements of an array with a blank between them; texts are escaped by TagWriter.
#ifndef STRIDE_PROCESS_VALUE_H
#define STRIDE_PROCESS_VALUE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <valarray>

#include <stride/time.h>
#include <stride/value_text.h>

namespace stride::process {

using stride::append_value;
using stride::Binary;
using stride::parse_value;
using stride::type_name;

/// A whole number that may have more than 64 bits.
inline void append_value(std::string& text, Picoseconds value) {
  char digits[40];
  char* first = std::end(digits);
  const bool is_negative = value < 0;
  do {
    *--first = static_cast<char>('0' + (is_negative ? -(value % 10) : value % 10));
    value /= 10;
  } while (value != 0);
  if (is_negative) *--first = '-';
  text.append(first, std::end(digits));
}

inline void parse_value(std::string_view text, Picoseconds& value) {
  constexpr std::size_t kMostDigits = 28;  // of kMaxSeconds
  const bool is_negative = !text.empty() && text.front() == '-';
  const std::string_view digits = text.substr(is_negative ? 1 : 0);
  const bool are_digits = digits.find_first_not_of("0123456789") == std::string_view::npos;
  if (digits.empty() || digits.size() > kMostDigits || !are_digits) {
    stride::detail::refuse_value(text, "Int64", "a whole number of at most 28 digits");
  }
  value = 0;
  for (const char digit : digits) value = 10 * value + (digit - '0');
  if (is_negative) value = -value;
}

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

// ---- Arrays ----

// A std::array or std::valarray of numbers or booleans: its elements, the last index running
// fastest.

namespace detail {

template <class T>
void append_elements(std::string& text, const T* elements, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    if (i != 0) text += ' ';
    append_value(text, elements[i]);
  }
}

template <class T>
void parse_elements(std::string_view text, T* elements, std::size_t size) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < size; ++i) {
    at = text.find_first_not_of(' ', at);
    if (at == std::string_view::npos) {
      throw std::invalid_argument("has " + std::to_string(i) + " elements; expected " +
                                  std::to_string(size));
    }
    const std::size_t end = std::min(text.find(' ', at), text.size());
    parse_value(text.substr(at, end - at), elements[i]);
    at = end;
  }
  if (text.find_first_not_of(' ', at) != std::string_view::npos) {
    throw std::invalid_argument("has more elements than the " + std::to_string(size) +
                                " that are expected");
  }
}

template <class T>
bool are_same(const T* one, const T* other, std::size_t size) {
  return std::equal(one, one + size, other, [](const T& a, const T& b) { return is_same(a, b); });
}

}  // namespace detail

template <class T, std::size_t N>
void append_value(std::string& text, const std::array<T, N>& value) {
  detail::append_elements(text, value.data(), N);
}
template <class T>
void append_value(std::string& text, const std::valarray<T>& value) {
  detail::append_elements(text, std::begin(value), value.size());
}

/// Reads as many elements as the array has. Throws as parse_value() of one does.
template <class T, std::size_t N>
void parse_value(std::string_view text, std::array<T, N>& value) {
  detail::parse_elements(text, value.data(), N);
}
template <class T>
void parse_value(std::string_view text, std::valarray<T>& value) {
  detail::parse_elements(text, std::begin(value), value.size());
}

template <class T, std::size_t N>
bool is_same(const std::array<T, N>& one, const std::array<T, N>& other) {
  return detail::are_same(one.data(), other.data(), N);
}
/// Of the same size.
template <class T>
bool is_same(const std::valarray<T>& one, const std::valarray<T>& other) {
  return detail::are_same(std::begin(one), std::begin(other), one.size());
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
