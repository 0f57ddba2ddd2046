// Frames on the air: what each receiver has heard of them so far.
#ifndef STRIDE_UNITS_CHANNEL_RECEPTION_H
#define STRIDE_UNITS_CHANNEL_RECEPTION_H

#include <cstdint>
#include <optional>
#include <vector>

#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace channel {

/// When a frame's bits are on the air, as its receiver sees it: from `begin` on a header, then the
/// bits in symbols of some each, then a trailer.
struct Transit {
  stride::Time begin{};
  stride::Duration header{};          ///< from the begin to the first symbol
  stride::Duration symbol{};          ///< the time of one
  std::uint32_t bits_per_symbol = 1;  ///< which are decided at its end
  stride::Duration trailer{};         ///< from the last symbol to the end
  std::uint32_t header_bits = 0;      ///< that have to be heard right for any other to be heard
  stride::Duration propagation{};     ///< since the sender began
  /// The start of the frame as received is later than that of the frame as sent by this much.
  stride::Duration delay{};
  /// The whole frame is needed before it can be sent: one whose sender stops is not sent at all.
  bool is_stored = false;

  /// The end of so many bits.
  stride::Time end_of_bits(std::size_t count) const;
};

/// As nfc::Frame defines: the start of communication, one bit long, then the bits, then one bit's
/// time for the end of communication. Propagation takes no time.
Transit nominal_transit(const nfc::Frame& frame);

/// One frame on its way to one receiver.
struct Reception {
  nfc::Frame sent;
  Transit transit;
  std::uint32_t tag = 0;     ///< that receives it, or that sent it
  std::uint64_t number = 0;  ///< among the sender's frames
  stride::Time end{};        ///< when the receiver gets it
  nfc::Bits heard;           ///< the bits that have ended, errors included
  bool has_header = true;    ///< the header, if it has one, is decided
  bool lost = false;         ///< the signal has failed; no bit comes any more
  bool deaf = false;  ///< the receiver has missed the header or is busy, and hears nothing of it
  double strongest = 0.0;              ///< greatest signal power of a bit that was heard [W]
  std::uint64_t next_observation = 0;  ///< the first that has not been looked at

  Reception() = default;
  Reception(const nfc::Frame& frame, const Transit& transit, std::uint32_t tag,
            std::uint64_t number);

  /// The end of the bit that is decided next; of the header, as long as that is not.
  stride::Time next_instant() const;
  bool complete() const { return heard.size() == sent.bits.size(); }
  bool overlaps(const Reception& other) const;
  /// Whether a receiver that has heard its header listens to it when another one begins.
  bool keeps_busy_at(stride::Time begin) const;
  bool is_heard() const { return !deaf && !heard.empty(); }
  nfc::Frame heard_frame() const { return {sent.start + transit.delay, sent.bit_rate, heard}; }

  /// Its sender has stopped after these bits.
  void cut(const nfc::Bits& bits);
  /// The carrier has failed at `now`: no receiver waits for more.
  void end_with_carrier(stride::Time now);
};

/// Takes the first of those that have ended by `now`, to this tag or to anyone, and the ones before
/// it of which nothing was heard.
std::optional<nfc::Frame> take_ended(std::vector<Reception>& receptions, stride::Time now,
                                     std::optional<std::uint32_t> tag = std::nullopt);

}  // namespace channel

#endif
