#include "master/util/hex.h"

#include <charconv>

namespace stride::core {

std::string to_hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  text.reserve(2 * bytes.size());
  write_hex(bytes, [&](char digit) { text += digit; });
  return text;
}

std::optional<std::uint8_t> hex_byte(std::string_view digits) {
  if (digits.size() < 2) return std::nullopt;
  const char* const end = digits.data() + 2;
  std::uint8_t byte = 0;
  return std::from_chars(digits.data(), end, byte, 16).ptr == end ? std::optional(byte)
                                                                  : std::nullopt;
}

std::optional<std::vector<std::uint8_t>> from_hex(std::string_view digits) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(digits.size() / 2);
  for (; !digits.empty(); digits.remove_prefix(2)) {
    const auto byte = hex_byte(digits);
    if (!byte) return std::nullopt;
    bytes.push_back(*byte);
  }
  return bytes;
}

}  // namespace stride::core
