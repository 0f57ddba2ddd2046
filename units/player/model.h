// The course of stimuli over time: which of them are due, and what is next.
#ifndef STRIDE_UNITS_PLAYER_MODEL_H
#define STRIDE_UNITS_PLAYER_MODEL_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "units/player/stimuli.h"

namespace player {

/// No instant.
inline constexpr stride::Time kNowhere = stride::Time::min();

/// Goes through the entries of stimuli, which must outlive it, from the first to the last, once
/// begin() was called. At an instant come first those that arrived there in Step Mode or in the
/// first event iteration, with play_until(); then the others, iteration by iteration, with
/// iterate().
class Playback {
 public:
  /// All that is to be kept when a state is saved.
  struct Position {
    std::uint64_t next = 0;      ///< the first entry that has not been played
    std::int64_t iteration = 0;  ///< event iterations at the present instant
    std::int64_t late = -1;      ///< an entry that was played behind its time
    /// [ps] An instant in a step that was not to be cut there.
    stride::Time beside = kNowhere;
  };

  explicit Playback(const Stimuli& stimuli) : stimuli_(&stimuli), ticked_(stimuli.inputs.size()) {}

  Position& position() { return position_; }
  const Position& position() const { return position_; }

  /// At the start, from the first entry on: the values that are there then. What ticked before is
  /// passed over.
  template <class Play>
  void begin(stride::Time start, Play&& play) {
    position_ = {};
    while (is_before_run(start)) {
      if (next().kind == Entry::Kind::Value) play(next());
      ++position_.next;
    }
  }
  /// Where a step has ended. Calls play(entry) for each value and tick that is
  /// due. Returns whether entries were passed: another target is next then.
  template <class Play>
  bool play_until(stride::Time now, Play&& play) {
    position_.iteration = Entry::kAtStepEnd;
    note_irregular(now);
    const std::uint64_t before = position_.next;
    play_due(now, play);
    return position_.next != before;
  }
  /// Another event iteration: what follows from it is seen in the next.
  template <class Play>
  void iterate(stride::Time now, Play&& play) {
    ++position_.iteration;
    play_due(now, play);
  }

  /// Whether something at `now` or before it waits for another iteration.
  bool has_more(stride::Time now) const;
  /// Where the captured unit was sent from here; nothing behind the end.
  std::optional<stride::Time> target() const;
  /// The next instant of which there are entries; nothing likewise.
  std::optional<stride::Time> following() const;

 private:
  const Entry& next() const { return stimuli_->entries[position_.next]; }
  /// The entry behind the next one.
  const Entry& after_next() const { return stimuli_->entries[position_.next + 1]; }

  template <class Play>
  void play_due(stride::Time now, Play&& play) {
    ticked_.assign(ticked_.size(), false);
    while (is_due(now)) {
      const Entry& entry = next();
      if (entry.kind == Entry::Kind::Tick) ticked_[entry.input] = true;
      if (entry.kind != Entry::Kind::Step) play(entry);
      ++position_.next;
    }
  }
  bool is_before_run(stride::Time start) const;
  bool is_due(stride::Time now) const;
  void note_irregular(stride::Time now);

  const Stimuli* stimuli_;
  Position position_;
  std::vector<bool> ticked_;  ///< by input: a clock ticks once an iteration
};

}  // namespace player

#endif
