// Two runs of a unit, with and without the skipping of its idle time.
#ifndef STRIDE_MASTER_STUDY_VERIFY_IDLE_COMPARISON_H
#define STRIDE_MASTER_STUDY_VERIFY_IDLE_COMPARISON_H

#include <optional>
#include <string>

#include "master/study/verify/idle_stimulus.h"
#include "master/study/verify/recording.h"

namespace stride::verify {

/// The first difference that the promises of the unit do not allow, of two recordings of IdleRun.
///
/// An output with a tolerance may be off by that for each promise up to there. All others are
/// equal, but for the rounding of floating-point numbers, and so are events: their instants, clocks
/// and messages. Where inputs moved within their deadbands unseen, an event may come earlier or
/// later by a step, and so may the outputs that follow it.
std::optional<std::string> idle_difference(const TestedUnit& tested, const Recording& full,
                                           const Recording& skipping, Wander wander);

}  // namespace stride::verify

#endif
