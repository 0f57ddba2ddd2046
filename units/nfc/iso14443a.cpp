#include <utility>

#include <stride/nfc/iso14443a.h>

namespace nfc {
namespace {

std::uint8_t odd_parity(std::uint8_t byte) {
  std::uint8_t ones = 0;
  for (int bit = 0; bit < 8; ++bit) ones ^= (byte >> bit) & 1;
  return ones ^ 1;
}

}  // namespace

std::uint16_t crc_a(const Bytes& bytes) {
  constexpr std::uint16_t kReversedPolynomial = 0x8408;
  std::uint16_t crc = 0x6363;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = static_cast<std::uint16_t>((crc >> 1) ^ ((crc & 1) != 0 ? kReversedPolynomial : 0));
    }
  }
  return crc;
}

Bytes with_crc(Bytes bytes) {
  const std::uint16_t crc = crc_a(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8));
  return bytes;
}

std::optional<Bytes> without_crc(const Bytes& bytes) {
  if (bytes.size() < 2) return std::nullopt;
  Bytes data(bytes.begin(), bytes.end() - 2);
  if (with_crc(data) != bytes) return std::nullopt;
  return data;
}

Bits to_bits(const Bytes& bytes) {
  Bits bits;
  bits.reserve(bytes.size() * kBitsPerByte);
  for (const std::uint8_t byte : bytes) {
    for (int bit = 0; bit < 8; ++bit) bits.push_back((byte >> bit) & 1);
    bits.push_back(odd_parity(byte));
  }
  return bits;
}

std::optional<Bytes> to_bytes(const Bits& bits) {
  if (bits.empty() || bits.size() % kBitsPerByte != 0) return std::nullopt;
  Bytes bytes;
  for (std::size_t first = 0; first < bits.size(); first += kBitsPerByte) {
    std::uint8_t byte = 0;
    for (std::size_t bit = 0; bit < 8; ++bit) {
      byte |= static_cast<std::uint8_t>(bits[first + bit] << bit);
    }
    if (bits[first + 8] != odd_parity(byte)) return std::nullopt;
    bytes.push_back(byte);
  }
  return bytes;
}

}  // namespace nfc
