// The channel between a reader's antenna and its tags': power one way, frames both ways.
#ifndef STRIDE_UNITS_NFC_CHANNEL_MODEL_H
#define STRIDE_UNITS_NFC_CHANNEL_MODEL_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <stride/nfc/frame.h>
#include <stride/time.h>

#include "units/nfc_channel/circuit.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/parameters.h"
#include "units/nfc_channel/reception.h"

namespace nfc_channel {

/// The power of the signal that each side gets from the other [W].
struct Signals {
  double down = 0.0;  ///< at the tag: what its load would get without the limiter
  double up = 0.0;    ///< at the reader: both sidebands of the load modulation

  bool operator==(const Signals& other) const { return down == other.down && up == other.up; }
};

/// The link to one tag at one instant. Ratios and probabilities are those of Parameters::bit_rate.
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

/// What all tags get at one instant, and give back.
struct Observation {
  stride::Time time;
  double carrier_power = 0.0;    ///< [W]
  std::vector<Signals> signals;  ///< of each tag

  bool operator==(const Observation& other) const {
    return time == other.time && carrier_power == other.carrier_power && signals == other.signals;
  }
};

/// At each instant call move() and then observe(); at an event also the frames that have begun,
/// from_reader() and from_tag(), and when all of them are in, fetch those that have ended with
/// to_tag() and to_reader() until they give nothing.
///
/// A frame enters when it begins, is held while it is on the air, and leaves when it has ended. A
/// bit is decided for the instant of its end, by the signals of that instant: between two observed
/// instants the logarithm of a signal's power is taken as linear in time. (Power falls with some
/// power of the distance, so its logarithm is nearly straight over a step, and a pose per bit would
/// cost an integral per bit.) A change of the carrier is exact: until the instant at which it is
/// observed the old one holds. So where poses rest, no result depends on which instants are
/// observed.
///
/// A frame may enter late, because its sender could not end its step where it began: it is heard as
/// if it had entered in time, if it began at the last instant observed before this one or later.
/// What it began before that is decided by the signals of that instant.
///
/// What fails for good while a frame is on the air - a tag below its power threshold, a reader
/// below its sensitivity - ends what is heard of it. A frame that is begun without power is not
/// heard, nor one of which no bit is left, nor one that overlaps a transmission of its receiver.
class Channel {
 public:
  /// All that a rollback has to bring back.
  struct State {
    /// In the order of time: the last one of the instant before the present one, then those of the
    /// present one. Where the carrier is switched there is one with each carrier power.
    std::vector<Observation> observed;
    std::uint64_t forgotten = 0;           ///< observations that were made before these
    std::vector<Reception> down, up;       ///< on the air, in the order in which they entered
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

  /// A frame has begun. The frame of the same start as one on the air replaces it: its sender has
  /// stopped after these bits.
  void from_reader(const nfc::Frame& frame);
  void from_tag(std::size_t tag, const nfc::Frame& frame);

  /// A frame that has ended, as it is heard; nothing if there is none any more.
  std::optional<nfc::Frame> to_tag(std::size_t tag);
  /// Likewise. Frames of several tags that overlap end together, with the last of them; what is
  /// weaker than the strongest by more than the capture ratio is masked by it.
  std::optional<nfc::Frame> to_reader();

  /// When the next frame ends, after the last instant observed.
  std::optional<stride::Time> next_end();

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
  stride::Time now() const;
  void add_observation(stride::Time now, double carrier_power);
  void decide();
  void decide(Reception& reception, bool up) const;
  void decide_bits(Reception& reception, bool up, std::size_t observation) const;
  void decide_bit(Reception& reception, bool up, std::size_t observation) const;
  double interference(const Reception& reception, std::size_t observation, double signal) const;
  bool is_too_weak(const Reception& reception, double signal, bool up) const;
  double signal_at(stride::Time time, std::size_t observation, std::size_t tag, bool up) const;
  std::optional<std::vector<std::size_t>> overlapping(std::size_t first) const;
  std::vector<nfc::Frame> take(const std::vector<std::size_t>& group);

  Parameters parameters_;
  std::vector<Tag> tags_;
  double reader_noise_density_;
  double capture_ratio_;

  double carrier_power_ = 0.0;
  std::vector<Link> links_;
  State state_;
};

}  // namespace nfc_channel

#endif
