// Whether a clocked module sees each value of its inputs, or skips some.
#ifndef STRIDE_SYSTEMC_SAMPLING_H
#define STRIDE_SYSTEMC_SAMPLING_H

#include <cstdint>
#include <string>

#include <stride/time.h>

namespace stride::systemc::detail {

/// Counts the changes of inputs after steps that were longer than the period of the clock that
/// samples them: within such a step they could not change.
class Sampling {
 public:
  /// `period`: of the fastest clock, 0 without one. `has_changed`: an input, since the last step
  /// began.
  void begin_step(Duration size, Duration period, bool has_changed);
  /// For the log, at the end of a run; empty after fewer than three changes.
  std::string warning(Duration period) const;

 private:
  static constexpr std::int64_t kFewest = 3;  ///< a button is pressed and released

  std::int64_t changes_ = 0;
  Duration last_{};
  Duration longest_{};
};

}  // namespace stride::systemc::detail

#endif
