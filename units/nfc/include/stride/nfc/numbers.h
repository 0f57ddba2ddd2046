// Numbers in the bytes of requests and answers: the most significant byte comes first.
#ifndef STRIDE_NFC_NUMBERS_H
#define STRIDE_NFC_NUMBERS_H

#include <cstddef>
#include <cstdint>

#include <stride/nfc/frame.h>

namespace nfc {

/// As many bytes as the type has.
template <class Unsigned>
Bytes most_significant_first(Unsigned number) {
  Bytes bytes(sizeof(Unsigned));
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes[i] = static_cast<std::uint8_t>(number >> (8 * (sizeof(Unsigned) - 1 - i)));
  }
  return bytes;
}

/// The number in the bytes from `first` to before `end`, four at most.
inline std::uint32_t number_in(const Bytes& bytes, std::size_t first, std::size_t end) {
  std::uint32_t number = 0;
  for (std::size_t i = first; i < end; ++i) number = number << 8 | bytes[i];
  return number;
}

}  // namespace nfc

#endif
