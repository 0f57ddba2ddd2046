// The part of a unit's clock that only the kit uses: what the importer has read of it.
#ifndef STRIDE_INTERFACES_UNIT_CLOCK_ACCESS_H
#define STRIDE_INTERFACES_UNIT_CLOCK_ACCESS_H

#include <stride/fmi3.h>
#include <stride/unit/clock.h>

namespace stride {

class ClockAccess {
 public:
  /// What fmi3GetInterval returns where the unit sets the interval, which counts as read then.
  static fmi3IntervalQualifier report(Clock& clock) {
    if (clock.knowledge_ == Clock::Knowledge::None) return fmi3IntervalNotYetKnown;
    const bool is_new = clock.knowledge_ == Clock::Knowledge::New;
    clock.knowledge_ = Clock::Knowledge::Reported;
    return is_new ? fmi3IntervalChanged : fmi3IntervalUnchanged;
  }
  static bool has_news(const Clock& clock) { return clock.knowledge_ == Clock::Knowledge::New; }
  /// What the unit set is void: the count has ended, or the unit will set it anew.
  static void forget(Clock& clock) { clock.knowledge_ = Clock::Knowledge::None; }
};

}  // namespace stride

#endif
