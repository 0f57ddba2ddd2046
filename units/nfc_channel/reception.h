// Frames on the air: what each receiver has heard of them so far.
#ifndef STRIDE_UNITS_NFC_CHANNEL_RECEPTION_H
#define STRIDE_UNITS_NFC_CHANNEL_RECEPTION_H

#include <cstdint>
#include <vector>

#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace nfc_channel {

/// One frame on its way to one receiver. A frame's time on the air begins with its start of
/// communication, one bit long; then come the bits; its end of communication is the last bit.
struct Reception {
  nfc::Frame sent;
  std::uint32_t tag = 0;     ///< that hears it, or that sent it
  std::uint64_t number = 0;  ///< among the sender's frames
  stride::Time end;          ///< when the receiver gets it
  nfc::Bits heard;           ///< the bits that have ended, errors included
  bool lost = false;         ///< the signal has failed; no bit comes any more
  bool deaf = false;         ///< the receiver transmits itself meanwhile, and hears nothing of it
  double strongest = 0.0;    ///< greatest signal power of a bit that was heard [W]
  std::uint64_t next_observation = 0;  ///< the first that has not been looked at

  Reception() = default;
  Reception(const nfc::Frame& frame, std::uint32_t tag, std::uint64_t number);

  /// The end of the bit that is decided next.
  stride::Time next_bit_end() const;
  bool complete() const { return heard.size() == sent.bits.size(); }
  bool overlaps(const Reception& other) const;
  bool is_heard() const { return !deaf && !heard.empty(); }
  nfc::Frame heard_frame() const { return {sent.start, sent.bit_rate, heard}; }

  /// Its sender has stopped after these bits.
  void cut(const nfc::Bits& bits);
  /// The carrier has failed at `now`: no receiver waits for more.
  void end_with_carrier(stride::Time now);
};

/// What a reader hears of frames that overlap, in the bits of the earliest. Where all senders send
/// the same bit at the same time, to a sixteenth of a bit, the reader hears that bit. Anything else
/// is a collision: bits that differ, which in Manchester code is a carrier modulated in both halves
/// (ISO/IEC 14443-3, 6.5.2), or frames that are not in step. A bit in collision is heard as 1, and
/// its byte gets a wrong parity bit, so that no collision is ever taken for a good frame.
nfc::Frame superposed(const std::vector<nfc::Frame>& frames);

}  // namespace nfc_channel

#endif
