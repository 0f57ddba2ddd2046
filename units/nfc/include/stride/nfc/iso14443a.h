// ISO/IEC 14443-3 type A: parity, CRC_A, and frames of whole bytes.
#ifndef STRIDE_NFC_ISO14443A_H
#define STRIDE_NFC_ISO14443A_H

#include <cstddef>
#include <cstdint>
#include <optional>

#include <stride/nfc/frame.h>

namespace nfc {

inline constexpr std::size_t kBitsPerByte = 9;  ///< of a standard frame: eight and parity

/// CRC_A over the bytes: x^16 + x^12 + x^5 + 1, initial value 6363 (ISO/IEC 14443-3, 6.2.4 and
/// annex B).
std::uint16_t crc_a(const Bytes& bytes);

/// The bytes followed by their CRC_A, low byte first.
Bytes with_crc(Bytes bytes);

/// The bytes before the CRC, or nothing if the CRC is wrong or missing.
std::optional<Bytes> without_crc(const Bytes& bytes);

/// A standard frame's bits: each byte least significant bit first, followed by its odd parity bit.
Bits to_bits(const Bytes& bytes);

/// The inverse, or nothing if a parity bit is wrong or the frame is not a whole number of bytes.
std::optional<Bytes> to_bytes(const Bits& bits);

}  // namespace nfc

#endif
