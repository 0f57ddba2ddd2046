// The channel between the reader's antenna and the tag's: power one way, frames both ways.
#ifndef STRIDE_UNITS_NFC_CHANNEL_MODEL_H
#define STRIDE_UNITS_NFC_CHANNEL_MODEL_H

#include <cstdint>
#include <optional>

#include "units/nfc/frame.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/link.h"

namespace nfc_channel {

struct Parameters {
  Coil reader_coil{0.030, 4, 0.5e-3, 0.0, 10.0};
  Coil tag_coil{0.015, 8, 0.1e-3, 0.0, 10.0};

  double load_match = 0.2;             ///< share of the optimal load's power that the tag's takes
  double modulation_depth = 0.1;       ///< amplitude of the tag's load modulation, 0 to 1
  double tag_power_limit = 10e-3;      ///< the tag's voltage limiter shunts what exceeds it [W]
  double tag_power_threshold = 50e-6;  ///< a tag with less does not demodulate [W]
  double reader_sensitivity = 1e-12;   ///< a reader that receives less does not demodulate [W]
  Noise tag_noise{290.0, 1e-8};
  Noise reader_noise{290.0, 1e-10};
  std::uint64_t seed = 1;  ///< of the bit errors
};

/// One direction of the channel: what its receiver gets.
struct Direction {
  double signal_power = 0.0;  ///< [W]
  bool heard = false;         ///< whether there is enough of it to demodulate a frame
};

/// The link at one instant.
struct Link {
  double distance = 0.0;   ///< between the coils' centres [m]
  double coupling = 0.0;   ///< k, 0 to 1
  double tag_power = 0.0;  ///< what the tag's antenna delivers [W]
  Direction down;          ///< reader to tag
  Direction up;            ///< tag to reader
};

/// Call move() whenever a coil or the carrier has changed, then read link() and pass frames on.
///
/// A frame is decided on at the instant at which it begins, with the coupling of that instant:
/// it is passed on at once with its start unchanged, each bit flipped with the probability that
/// the signal-to-noise ratio gives. Propagation takes no time; the receiver knows when the frame
/// ends from its start and nfc::air_time().
class Channel {
 public:
  /// What a rollback has to bring back: how many frames have entered in each direction.
  struct State {
    std::uint64_t frames_down = 0;
    std::uint64_t frames_up = 0;
  };

  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

  /// Both poses in the same coordinates, carrier power in [W], 0 for an antenna that is off.
  /// Throws std::invalid_argument for an axis of length zero, a negative power or what is no
  /// number.
  void move(const Pose& reader_coil, const Pose& tag_coil, double carrier_power);

  const Link& link() const { return link_; }
  double snr_down(double bit_rate) const;  ///< for a bit rate in [bit/s], linear
  double snr_up(double bit_rate) const;    ///< likewise

  /// What the tag hears of a frame from the reader; nothing if it has too little power.
  std::optional<nfc::Frame> to_tag(const nfc::Frame& frame);
  /// What the reader hears of a frame from the tag; nothing if the signal is too weak.
  std::optional<nfc::Frame> to_reader(const nfc::Frame& frame);

  State& state() { return state_; }

 private:
  Parameters parameters_;
  Link link_;
  State state_;
};

}  // namespace nfc_channel

#endif
