// The channel between a reader's antenna and its tags': power one way, frames both ways.
#ifndef STRIDE_UNITS_NFC_CHANNEL_MODEL_H
#define STRIDE_UNITS_NFC_CHANNEL_MODEL_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <stride/time.h>

#include "units/nfc/frame.h"
#include "units/nfc_channel/circuit.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/parameters.h"
#include "units/nfc_channel/reception.h"

namespace nfc_channel {

/// The power of the signal that each side gets from the other [W].
struct Signals {
  double down = 0.0;  ///< at the tag: what its load would get without the limiter
  double up = 0.0;    ///< at the reader: both sidebands of the load modulation
};

/// The link to one tag at one instant. Ratios and probabilities are those of 106 kbit/s.
struct Link {
  double distance = 0.0;        ///< between the coils' centres [m]
  double mutual = 0.0;          ///< mutual inductance [H]
  double coupling = 0.0;        ///< k, 0 to 1
  double field_strength = 0.0;  ///< along the tag's axis, mean over its coil, effective [A/m]
  double tag_voltage = 0.0;     ///< amplitude at the chip [V]
  double tag_power = 0.0;       ///< into the tag's load [W]
  Signals signals;
  double snr_down = 0.0;  ///< Eb/N0, linear
  double snr_up = 0.0;
  double bit_error_rate_down = 0.0;
  double bit_error_rate_up = 0.0;
};

/// At each instant call move() and then observe(); at an event also the frames that begin,
/// from_reader() and from_tag(), and then fetch those that have ended with to_tag() and
/// to_reader() until they give nothing.
///
/// A frame enters when it begins, is held while it is on the air, and leaves when it has ended. A
/// bit is decided for the instant of its end, by the signals of that instant: between two observed
/// instants the logarithm of a signal's power is taken as linear in time. (Power falls with some
/// power of the distance, so its logarithm is nearly straight over a step, and a pose per bit would
/// cost an integral per bit.) A change of the carrier is exact: until the instant at which it is
/// observed the old one holds. So where poses rest, no result depends on which instants are
/// observed.
///
/// What fails for good while a frame is on the air - a tag below its power threshold, a reader
/// below its sensitivity - ends what is heard of it. A frame that is begun without power is not
/// heard, nor one of which no bit is left, nor one that overlaps a transmission of its receiver.
class Channel {
 public:
  /// All that a rollback has to bring back.
  struct State {
    stride::Time time;                     ///< last instant observed
    double carrier_power = 0.0;            ///< at that instant [W]
    std::vector<Signals> signals;          ///< for each tag, likewise
    std::vector<Reception> down, up;       ///< on the air, in the order in which they began
    std::uint64_t frames_down = 0;         ///< that have entered so far
    std::vector<std::uint64_t> frames_up;  ///< of each tag, likewise
  };

  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

  std::size_t tag_count() const { return tags_.size(); }

  /// The poses are in the same coordinates, one for each tag; carrier power in [W], 0 for an
  /// antenna that is off. Throws std::invalid_argument for an axis of length zero, a negative power
  /// or what is no number, naming it.
  void move(const Pose& reader_coil, const std::vector<Pose>& tag_coils, double carrier_power);

  const Link& link(std::size_t tag = 0) const { return links_[tag]; }

  /// What move() has set holds from `now` on, which is not before the last instant observed.
  void observe(stride::Time now);

  /// A frame begins now. The frame of the same start as one on the air replaces it: its sender has
  /// stopped after these bits.
  void from_reader(const nfc::Frame& frame);
  void from_tag(std::size_t tag, const nfc::Frame& frame);

  /// A frame that has ended, as it is heard; nothing if there is none any more.
  std::optional<nfc::Frame> to_tag(std::size_t tag);
  /// Likewise. Frames of several tags that overlap end together, with the last of them; what is
  /// weaker than the strongest by more than the capture ratio is masked by it.
  std::optional<nfc::Frame> to_reader();

  /// When the next frame ends, after the last instant observed.
  std::optional<stride::Time> next_end() const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  struct Tag {
    TagParameters parameters;
    Circuit circuit;
    std::array<BitSignal, 4> down, up;  // of each bit rate
    double noise_density;
  };

  void move_tag(std::size_t index, const Pose& reader_coil, const Pose& tag_coil);
  Signals signals(std::size_t index, double carrier_power) const;
  void decide_bits(stride::Time now, double carrier_power);
  void decide_down(Reception& reception, stride::Time now) const;
  void decide_up(Reception& reception, stride::Time now) const;
  double interference(const Reception& reception, stride::Time time, double signal) const;
  void lose_weak();
  std::optional<std::vector<std::size_t>> overlapping(std::size_t first) const;
  std::vector<nfc::Frame> take(const std::vector<std::size_t>& group);
  bool is_lost(const Reception& reception, double signal, double least) const;
  double signal_at(stride::Time time, std::size_t tag, double Signals::*direction) const;

  Parameters parameters_;
  std::vector<Tag> tags_;
  double reader_noise_density_;
  double capture_ratio_;

  double carrier_power_ = 0.0;
  std::vector<Link> links_;
  std::vector<Signals> arriving_;  // of the instant that is being observed
  stride::Time arriving_at_;
  State state_;
};

}  // namespace nfc_channel

#endif
