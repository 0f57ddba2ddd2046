// Bytes as hexadecimal digits.
#ifndef STRIDE_MASTER_BASE_TEXT_HEX_H
#define STRIDE_MASTER_BASE_TEXT_HEX_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <stride/value_text.h>

namespace stride::core {

/// Calls write(char) with two lower-case digits for each byte.
template <class Write>
void write_hex(std::span<const std::uint8_t> bytes, Write&& write) {
  for (const std::uint8_t byte : bytes) write_hexadecimal(byte, write);
}

std::string to_hex(std::span<const std::uint8_t> bytes);

/// The byte that the first two characters are, in either case; nothing if they are no digits.
std::optional<std::uint8_t> hex_byte(std::string_view digits);
/// Likewise all bytes of a text.
std::optional<std::vector<std::uint8_t>> from_hex(std::string_view digits);

}  // namespace stride::core

#endif
