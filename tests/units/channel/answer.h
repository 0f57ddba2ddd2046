#ifndef STRIDE_TESTS_UNITS_CHANNEL_ANSWER_H
#define STRIDE_TESTS_UNITS_CHANNEL_ANSWER_H

#include <stride/nfc/iso14443a.h>

namespace channel::tests {

inline const stride::Time kStart = stride::time_from_seconds(2.0);
inline const stride::Duration kBit = nfc::bit_duration(106);

/// A tag's answer with these bytes and their CRC.
inline nfc::Frame answer(const nfc::Bytes& bytes, stride::Time start = kStart) {
  return {start, 106, nfc::to_bits(nfc::with_crc(bytes))};
}

}  // namespace channel::tests

#endif
