// What was true, and when.
#ifndef STRIDE_UNITS_GROUND_TRUTH_HISTORY_H
#define STRIDE_UNITS_GROUND_TRUTH_HISTORY_H

#include <deque>
#include <optional>

#include <stride/time.h>

namespace ground_truth {

/// How coarsely the past is remembered.
struct Grain {
  double width = 0.0;       ///< of bounds, in the unit of the quantity, >= 0
  stride::Duration time{};  ///< >= 0
};

/// Remembers between which bounds a quantity was. Its values are noted at instants, any distance
/// apart; between two of them the quantity counts as anywhere between both values.
///
/// Neighbouring intervals are joined as long as their bounds together are no wider than the grain,
/// or they together are no longer, so that neither a slow course nor a fast one takes much memory.
/// What between() gives is therefore too wide by the grain at most, or holds for an interval that
/// reaches further by the grain at most.
class History {
 public:
  struct Piece {
    stride::Time from;  ///< until the next one begins, or until the last instant
    double low, high;
  };
  /// All that a rollback has to bring back.
  struct State {
    std::deque<Piece> pieces;
    stride::Time last;  ///< of the last value that was noted
    double value = 0.0;
  };
  struct Bounds {
    double low, high;
    bool is_complete;  ///< nothing of the interval is forgotten, or before the first instant
  };

  History() = default;
  /// What is older than `length` may be forgotten.
  History(Grain grain, stride::Duration length) { configure(grain, length); }
  /// From now on; what is remembered stays.
  void configure(Grain grain, stride::Duration length) { grain_ = grain, length_ = length; }

  /// The value at an instant, which is not before the last one. At the same instant it is a jump:
  /// then both values count.
  void note(stride::Time time, double value);

  /// Between which bounds the quantity was in an interval, both ends included, that ends at the
  /// last instant at the latest. Nothing if that is not known for any of it.
  std::optional<Bounds> between(stride::Time from, stride::Time to) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  bool join(stride::Time time, double value);
  void forget();

  Grain grain_;
  stride::Duration length_{};
  State state_;
};

}  // namespace ground_truth

#endif
