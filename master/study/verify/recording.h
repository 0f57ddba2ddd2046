// What was seen of a unit during a run.
#ifndef STRIDE_MASTER_STUDY_VERIFY_RECORDING_H
#define STRIDE_MASTER_STUDY_VERIFY_RECORDING_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/study/verify/row.h"
#include "master/study/verify/step_outcome.h"
#include "master/study/verify/tested_unit.h"

namespace stride::verify {

struct Recording {
  std::vector<Row> rows;
  std::vector<StepOutcome> steps{};
  /// Beside what was recorded, how the unit went on.
  std::size_t rejections = 0, early_returns = 0, events = 0;
  Time first_early_return{};
  Duration longest_promise{};  ///< of one without an end Duration::max()
  Duration longest_suspension{};
  bool has_ended = false;  ///< the unit wanted the simulation to end

  bool operator==(const Recording&) const = default;
  Recording without_events() const;
};

/// `expected_when`, `seen_when`: "in the first run", "in the second". Nothing if the rows are
/// equal.
std::optional<std::string> difference(const TestedUnit& tested, const std::vector<Row>& expected,
                                      const std::vector<Row>& seen,
                                      const std::string& expected_when,
                                      const std::string& seen_when);

/// Likewise, but for what is as small as the rounding of a solver that begins anew; then `note`
/// says how large it is.
std::optional<std::string> difference_beyond_rounding(
    const TestedUnit& tested, const std::vector<Row>& expected, const std::vector<Row>& seen,
    const std::string& expected_when, const std::string& seen_when, std::string& note);

/// Names of the columns of a communication point.
std::vector<std::string> observed_names(const TestedUnit& tested);

/// The two ways between processes.
std::string to_text(const Recording& recording);
Recording recording_from_text(const std::string& text);

}  // namespace stride::verify

#endif
