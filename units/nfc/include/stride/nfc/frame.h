// The message that travels between reader, channel and sensor: one frame on the air.
//
// A transmitter hands its frame over at the instant at which the frame begins, which is its start.
// One that has to stop in the middle, because its power or its carrier is lost, hands the frame
// over again at the instant of the cut: with the same start, and with the bits that got out
// (cut_off()); this replaces the frame that is still on the air.
//
// A receiver is handed what it hears at the instant at which it ends there: the end of the frame,
// or where the signal was lost. Its start is unchanged, or later by the time that the channel
// takes, so that the frame ends as it is handed over. What is lost are bits at the end; a frame of
// which not one bit is heard is not handed over.
#ifndef STRIDE_NFC_FRAME_H
#define STRIDE_NFC_FRAME_H

#include <cstdint>
#include <vector>

#include <stride/time.h>

namespace nfc {

using Bytes = std::vector<std::uint8_t>;
/// Bits in the order in which they are on the air, one per element, each 0 or 1.
using Bits = std::vector<std::uint8_t>;

inline constexpr double kCarrierFrequency = 13.56e6;  ///< [Hz], ISO/IEC 14443-2, 6.1

/// A frame as the modulator sends it: parity bits included, start and end of communication left
/// out. They last one bit each and count as air time: bit i is on the air from start + (i + 1) bit
/// durations on.
struct Frame {
  stride::Time start;            ///< the instant at which the start of communication begins
  std::uint32_t bit_rate = 106;  ///< nominal [kbit/s]: 106, 212, 424 or 848
  Bits bits;

  bool operator==(const Frame& other) const {
    return start == other.start && bit_rate == other.bit_rate && bits == other.bits;
  }
};

/// The time of one bit: 128, 64, 32 or 16 carrier periods (ISO/IEC 14443-2, 8.1.1 and 8.2.1).
/// Throws std::invalid_argument for any other rate than the four.
stride::Duration bit_duration(std::uint32_t bit_rate);

/// From the start of the frame to its end, start and end of communication included.
stride::Duration air_time(const Frame& frame);

/// The frame as it is when its transmitter stops at `time`: with the bits that are out by then,
/// each of them whole; none if it stops before the first has ended.
Frame cut_off(Frame frame, stride::Time time);

/// The value of a Binary variable that holds a frame, little-endian: start [ps] (8 bytes), bit rate
/// [kbit/s] (2), how often 2^64 ps come on top of the start (2, signed; 0 for some 100 days),
/// number of bits (4), then the bits, eight to a byte, the first in the least significant place.
Bytes encode(const Frame& frame);

/// The inverse. Throws std::invalid_argument if the bytes are not a frame.
Frame decode(const Bytes& payload);

}  // namespace nfc

#endif
