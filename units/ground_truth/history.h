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

/// Remembers a quantity that is held between the instants at which it jumps, as inputs are between
/// two communication points. So it does not matter how often it is noted in between.
///
/// Neighbouring intervals are joined as long as their values differ by no more than the grain, or,
/// once they are over, they together are no longer, so that neither a slow course nor a fast one
/// takes much memory. What between() gives is therefore too wide by the grain at most, or holds for
/// an interval that reaches further by the grain at most.
class History {
 public:
  struct Piece {
    stride::Time from;  ///< until the next one begins, or until the last instant
    double low, high;   ///< of its values
  };
  /// All that a rollback has to bring back.
  struct State {
    std::deque<Piece> pieces;
    stride::Time last;   ///< of the last value that was noted
    double value = 0.0;  ///< that one
  };
  struct Bounds {
    double low, high;
    bool is_complete;  ///< nothing of the interval is forgotten, or before the first instant
  };

  History() = default;
  /// What is older than `length` may be forgotten.
  History(Grain grain, stride::Duration length) { configure(grain, length); }
  /// From now on; what is remembered stays.
  void configure(Grain grain, stride::Duration length);

  /// The value from an instant on, which is not before the last one. If it is another one than
  /// before, the quantity jumps there, and both values count at this instant.
  void note(stride::Time time, double value);

  /// Between which bounds the quantity was in an interval, both ends included, that ends at the
  /// last instant at the latest. Nothing if that is not known for any of it.
  std::optional<Bounds> between(stride::Time from, stride::Time to) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  void jump(stride::Time time, double value);
  void forget();

  Grain grain_;
  stride::Duration length_{};
  State state_;
};

}  // namespace ground_truth

#endif
