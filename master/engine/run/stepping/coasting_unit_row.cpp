// How a unit whose state is not saved before each step steps in a row.
#include <algorithm>
#include <utility>

#include "master/engine/run/stepping/coasting_row.h"
#include "master/engine/run/stepping/coasting_unit.h"

namespace stride::core {

void CoastingUnit::set_row(CoastingRow* row, std::size_t index, const StepValues& values) {
  row_ = {row, index, values};
}

std::size_t CoastingUnit::steps_in_row() const {
  return static_cast<std::size_t>(row_.row->log().end() - row_.joined);
}

void CoastingUnit::join_row(std::size_t stretch) {
  if (is_save_due()) {
    row_.is_joined = false;
    stretch_ = std::min(stretch, interval_.most());
    state_.save_state();
    begin_log();
  }
  if (row_.is_joined) return;
  row_.is_joined = true;
  row_.joined = row_.row->log().end();
}

StepResult CoastingUnit::step_in_row(const StepInterval& interval, const StepValues& values) {
  StepInterval step = interval;
  step.may_go_back_before = steps() > 0;
  return inner().step(step, values);
}

void CoastingUnit::end_step_in_row(const StepResult& result) {
  const std::uint64_t position = row_.row->log().end() - 1;
  if (!result.rejected && result.reached == row_.row->log().interval(position).to) return;
  if (!result.rejected) return take_last_step(result.reached);
  take_steps(position);
  take_inputs(position);
  note_save();
}

void CoastingUnit::count_rollback() {
  interval_.count_rollback();
  if (row_.is_joined) row_.row->count_rollback();
}

/// The next save may be made.
void CoastingUnit::leave_before_save() {
  if (!row_.is_joined) return;
  row_.row->is_save_cheaper(steps_in_row()) ? drop_row() : leave_row();
}

void CoastingUnit::leave_before_step() {
  if (!row_.is_joined) return;
  if (row_.row->is_save_cheaper(steps_in_row())) return drop_row();
  take_steps(row_.row->log().end() - 1);
  note_save();
}

void CoastingUnit::leave_behind_step() {
  const RowLog& log = row_.row->log();
  if (log.end() == row_.joined) return drop_row();
  take_last_step(log.interval(log.end() - 1).to);
}

void CoastingUnit::drop_row() {
  is_continuous_ = false;
  if (!std::exchange(row_.is_joined, false)) return;
  row_.row->note_departure();
}

/// The steps before this position, and leaves the row's notes.
void CoastingUnit::take_steps(std::uint64_t end) {
  row_.is_joined = false;
  row_.row->note_departure();
  for (std::uint64_t position = row_.joined; position < end; ++position) {
    take_inputs(position);
    take_step(position, row_.row->log().interval(position).to);
  }
  if (end > row_.joined) keep_outputs(row_.values.outputs);
}

/// Likewise, with the last one, at whose beginning the state would have been saved.
void CoastingUnit::take_last_step(Time reached) {
  const RowLog& log = row_.row->log();
  const std::uint64_t last = log.end() - 1;
  take_steps(last);
  if (last > row_.joined) keep_outputs(log.outputs_before(row_.index));
  take_inputs(last);
  note_save();
  take_step(last, reached);
  keep_outputs(row_.values.outputs);
}

void CoastingUnit::take_inputs(std::uint64_t position) {
  for (const BoundValues& input : row_.values.inputs) {
    log_.add_inputs(input.references, row_.row->log().inputs(row_.index, position));
  }
}

void CoastingUnit::take_step(std::uint64_t position, Time reached) {
  StepInterval step = row_.row->log().interval(position);
  step.may_go_back_before = log_.steps() > 0;
  log_.add_step(step, row_.values.outputs, {.reached = reached});
}

}  // namespace stride::core
