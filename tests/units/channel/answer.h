// What the tests of channels send.
#ifndef STRIDE_TESTS_UNITS_CHANNEL_ANSWER_H
#define STRIDE_TESTS_UNITS_CHANNEL_ANSWER_H

#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>
#include <stride/time.h>

namespace stride::tests {

inline const Time kStart = time_from_seconds(2.0);
inline const Duration kBit = nfc::bit_duration(106);

/// A tag's answer, with its checksum.
inline nfc::Frame answer(const nfc::Bytes& bytes, Time start = kStart) {
  return {start, 106, nfc::to_bits(nfc::with_crc(bytes))};
}

}  // namespace stride::tests

#endif
