#include "master/base/text/hex.h"

#include <utility>

namespace stride::core {

std::string to_hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve(2 * bytes.size());
  write_hex(bytes, [&](char digit) { text += digit; });
  return text;
}

std::optional<std::uint8_t> hex_byte(std::string_view digits) {
  if (digits.size() < 2) return std::nullopt;
  const int high = hexadecimal_digit(digits[0]);
  const int low = hexadecimal_digit(digits[1]);
  if (high < 0 || low < 0) return std::nullopt;
  return static_cast<std::uint8_t>(16 * high + low);
}

std::optional<std::vector<std::uint8_t>> from_hex(std::string_view digits) {
  std::vector<std::uint8_t> bytes;
  return parse_hexadecimal(digits, bytes) ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace stride::core
