#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_VALUE_WINDOW_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_VALUE_WINDOW_H

#include <cstddef>
#include <set>

namespace stride::compare {

/// The numbers that a signal has within an interval of time that moves on. Each function takes
/// logarithmic time.
class ValueWindow {
 public:
  void add(double value);
  /// One that was added.
  void remove(double value);

  /// The one that is nearest to this number; with `is_connected`, of all between the least and the
  /// greatest one, if these are finite. Of no numbers, or none but NaN, that is NaN; NaN is nearest
  /// to NaN where it is among them.
  double nearest(double value, bool is_connected) const;

 private:
  std::multiset<double> numbers_;
  std::size_t not_numbers_ = 0;
};

}  // namespace stride::compare

#endif
