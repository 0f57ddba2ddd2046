// Frames on the air between a reader and tags: which bits each receiver hears, and when.
#ifndef STRIDE_UNITS_CHANNEL_AIR_H
#define STRIDE_UNITS_CHANNEL_AIR_H

#include <cstdint>
#include <optional>
#include <vector>

#include <stride/nfc/frame.h>
#include <stride/time.h>

#include "units/channel/reception.h"

namespace channel {

enum class Direction { Down, Up };  ///< from the reader to a tag, from a tag to the reader

/// The power of the signal that each side gets from the other [W].
struct Signals {
  double down = 0.0;  ///< at the tag
  double up = 0.0;    ///< at the reader

  double of(Direction direction) const { return direction == Direction::Up ? up : down; }
  bool operator==(const Signals& other) const { return down == other.down && up == other.up; }
};

/// The signals of all tags at one instant.
struct Observation {
  stride::Time time;
  double carrier_power = 0.0;    ///< [W]
  std::vector<Signals> signals;  ///< of each tag

  bool operator==(const Observation& other) const {
    return time == other.time && carrier_power == other.carrier_power && signals == other.signals;
  }
};

/// How the reader receives frames of several tags that are on the air at once.
enum class Overlap {
  Superpose,  ///< one message (superposed()), but for tags that are masked by a stronger one
  Interfere,  ///< it hears the one whose header came first; each is noise to the others
  Pass,       ///< each by itself
};

struct Rules {
  Overlap overlap = Overlap::Superpose;
  bool half_duplex = true;  ///< a receiver does not receive what overlaps its transmission
  double capture_ratio =
      1.0;  ///< with Overlap::Superpose: a tag stronger by this factor masks another
};

/// A channel's frames. A technology derives from it and defines how strong signals are and how
/// often bits are wrong; this class decides which bits are heard, and when.
///
/// At each instant bring the signals up to date, whose carrier power is carrier_power(), and then
/// observe(); at an event also the frames that have begun, from_reader() and from_tag(), and when
/// all of them are in, fetch those that have ended with to_tag() and to_reader() until they give
/// nothing.
///
/// A frame enters when it begins, is held while it is on the air, and leaves when it has ended. A
/// bit is decided for the instant of its end, by the signals of that instant: between two observed
/// instants the logarithm of a signal's power is taken as linear in time. (Power falls with some
/// power of the distance, so its logarithm is nearly straight over a step, and a pose per bit would
/// cost the technology's computation per bit.) A change of the carrier is exact: until the instant
/// at which it is observed the old one holds. So while signals are constant, no result depends on
/// which instants are observed.
///
/// A frame may enter late, because its sender could not end its step where it began: it is heard as
/// if it had entered in time, if it began at the last instant observed before this one or later.
/// What it began before that is decided by the signals of that instant.
///
/// What fails for good while a frame is on the air - a signal below what its receiver needs - ends
/// what is heard of it. A frame that is begun without a signal is not heard, nor one of which no
/// bit is left, nor one that overlaps a transmission of its receiver.
class Air {
 public:
  /// All that a rollback has to bring back.
  struct State {
    /// In the order of time: the last one of the instant before the present one, then those of the
    /// present one. Where the carrier is switched there is one with each carrier power.
    std::vector<Observation> observed;
    std::uint64_t forgotten = 0;           ///< observations that were made before these
    std::vector<Reception> down, up;       ///< on the air, in the order in which they begin
    std::uint64_t frames_down = 0;         ///< that have entered so far
    std::vector<std::uint64_t> frames_up;  ///< of each tag, likewise
  };

  virtual ~Air() = default;

  std::size_t tag_count() const { return state_.frames_up.size(); }

  /// What was set last holds from `now` on, which is not before the last instant observed.
  void observe(stride::Time now);

  /// A frame has begun. The frame of the same start as one that has not ended replaces it: its
  /// sender has stopped after these bits.
  void from_reader(const nfc::Frame& frame);
  void from_tag(std::size_t tag, const nfc::Frame& frame);

  /// A frame that has ended, as it is heard; nothing if there is none any more.
  std::optional<nfc::Frame> to_tag(std::size_t tag);
  /// Likewise. Frames that overlap and are superposed end together, with the last of them.
  std::optional<nfc::Frame> to_reader();

  /// When the next frame ends, after the last instant observed.
  std::optional<stride::Time> next_end();

  bool is_quiet() const { return state_.down.empty() && state_.up.empty(); }

  State& state() { return state_; }
  const State& state() const { return state_; }

 protected:
  Air(std::size_t tag_count, const Rules& rules, std::uint64_t seed);
  Air(const Air&) = default;
  Air& operator=(const Air&) = default;

  /// Of the technology at the present instant [W].
  virtual double carrier_power() const = 0;
  /// What each side gets of the other, and would get with another carrier power [W].
  virtual Signals signals(std::size_t tag, double carrier_power) const = 0;

  /// A receiver with less [W] receives nothing.
  virtual double least_signal(Direction direction, std::size_t tag) const = 0;
  /// That a bit is heard wrong: 0 to 0.5. `others` is the power of other frames at this receiver.
  virtual double bit_error_probability(Direction direction, std::size_t tag, std::uint32_t bit_rate,
                                       double signal, double others) const = 0;
  /// When the frame is on the air; unless a technology defines it otherwise, as nfc::Frame does.
  /// Its sender is busy with frames before until `free`.
  virtual Transit transit(const nfc::Frame& frame, std::size_t tag, stride::Time free) const;

 private:
  std::vector<Reception>& receptions(Direction direction);
  stride::Time now() const;
  void add_observation(stride::Time now, double carrier_power);
  void decide();
  void decide(Reception& reception, Direction direction);
  void decide_bits(Reception& reception, Direction direction, std::size_t observation);
  void decide_next(Reception& reception, Direction direction, std::size_t observation);
  void hear_header(Reception& reception, Direction direction, double error_probability);
  double disturbance(const Reception& reception, std::size_t observation, double signal) const;
  bool is_too_weak(const Reception& reception, double signal, Direction direction) const;
  double signal_at(stride::Time time, std::size_t observation, std::size_t tag,
                   Direction direction) const;
  std::optional<nfc::Frame> superposed_at_reader();
  std::optional<std::vector<std::size_t>> overlapping(std::size_t first) const;
  std::vector<nfc::Frame> take(const std::vector<std::size_t>& group);

  Rules rules_;
  std::uint64_t seed_;
  State state_;
};

}  // namespace channel

#endif
