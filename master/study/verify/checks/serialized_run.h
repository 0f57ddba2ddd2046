// A run, and states of it as bytes.
#ifndef STRIDE_MASTER_STUDY_VERIFY_CHECKS_SERIALIZED_RUN_H
#define STRIDE_MASTER_STUDY_VERIFY_CHECKS_SERIALIZED_RUN_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "master/study/verify/checks.h"
#include "master/study/verify/row.h"
#include "master/study/verify/test_instance.h"

namespace stride::verify {

/// Where a state is serialised: at a point of the grid, before or after its inputs were handed
/// over, which is an event where they are discrete, a clock ticks or the unit wants one.
struct Cut {
  std::size_t point = 0;
  bool is_after_inputs = false;
  std::string place;  ///< "", "before an event", "right after an event"

  auto order() const { return std::pair(point, is_after_inputs); }
};

struct SerializedState {
  Cut cut;
  std::vector<std::uint8_t> bytes;
  TestInstance::Position position;
  std::size_t rows = 0;  ///< that were recorded up to there
};

struct SerializedRun {
  std::vector<SerializedState> states;  ///< none of what is behind the end that the unit requests
  std::vector<Row> rows;                ///< of the whole run
  std::size_t to = 0;                   ///< the point where it ends

  std::vector<Row> rows_after(const SerializedState& state) const;
};

/// From the start of the grid to 80 % of it, with states at 30 % of it and around the first event
/// and the first tick of a clock from there on.
std::vector<Cut> choose_cuts(const Trial& trial);

/// The run, in this process. Throws Failure where a state cannot be saved.
SerializedRun run_with_cuts(const Trial& trial, const std::vector<Cut>& cuts);

/// One that gets there as the run does.
TestInstance instance_at(const Trial& trial, const Cut& cut);

/// Makes the instance what it was where the state was serialised. The importer's own schedule of
/// time-based clocks is not in the state: a second instance, which makes the same steps, has it.
void restore(const Trial& trial, TestInstance& instance, const SerializedState& state);

/// From there to the end of the run.
void finish_from(TestInstance& instance, const SerializedState& state, std::size_t to);

/// The two ways between processes.
std::string to_text(const SerializedRun& run);
SerializedRun serialized_run_from_text(const std::string& text);

}  // namespace stride::verify

#endif
