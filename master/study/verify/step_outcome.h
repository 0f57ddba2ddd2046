// How the steps of a unit ended.
#ifndef STRIDE_MASTER_STUDY_VERIFY_STEP_OUTCOME_H
#define STRIDE_MASTER_STUDY_VERIFY_STEP_OUTCOME_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

namespace stride::verify {

struct StepOutcome {
  Time begin{}, end{};
  bool is_rejected = false;
  bool needs_event = false;
  bool ends_run = false;  ///< the unit wanted the simulation to end

  bool operator==(const StepOutcome&) const = default;
};

/// `expected_when`, `seen_when`: "after the save", "when it is repeated". Nothing if the steps
/// ended alike, but for instants that differ by as little as the rounding of a solver that begins
/// anew; then `note` names the first of them.
std::optional<std::string> difference_beyond_rounding(const std::vector<StepOutcome>& expected,
                                                      const std::vector<StepOutcome>& seen,
                                                      const std::string& expected_when,
                                                      const std::string& seen_when,
                                                      std::string& note);

}  // namespace stride::verify

#endif
