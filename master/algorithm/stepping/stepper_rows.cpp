// Units that step in rows.
#include <utility>
#include <vector>

#include "master/algorithm/stepping/stepper.h"

namespace stride::core {

/// Of units that are plain, and whose states are not saved.
void Stepper::form_rows() {
  std::vector<StepsInARow::Member> members;
  for (std::size_t i = 0; i <= unit_steps_.size(); ++i) {
    const StepValues* const values =
        i < unit_steps_.size() && unit_steps_[i].is_plain && !unit_steps_[i].saves_state
            ? exchange_.fixed_step_values(unit_steps_[i].component)
            : nullptr;
    if (values != nullptr) {
      members.push_back({unit_steps_[i].unit, *values});
    } else {
      form_rows(i - members.size(), members);
      members.clear();
    }
  }
  std::size_t in_rows = 0;
  for (Row& row : rows_) {
    row.steps.front().begins_row = true;
    for (UnitStep& unit_step : row.steps) unit_step.row = &row;
    in_rows += row.steps.size();
  }
  are_all_in_rows_ = in_rows == unit_steps_.size();
}

/// `first`: the position of the first of the members.
void Stepper::form_rows(std::size_t first, std::span<const StepsInARow::Member> members) {
  while (!members.empty()) {
    auto* const capability = members.front().unit->capability<StepsInARow>();
    std::unique_ptr<UnitRow> units;
    if (capability != nullptr) units = capability->make_row(members);
    const std::size_t size = units != nullptr ? units->size() : 1;
    if (units != nullptr) {
      rows_.push_back({std::move(units), std::span(unit_steps_).subspan(first, size)});
    }
    first += size;
    members = members.subspan(size);
  }
}

/// As step_plainly(), of the units of successive rows, up to the first one of which there is
/// something to record: returns whether there is none. `last` is the last one that has stepped.
bool Stepper::step_rows(std::span<Row> rows, UnitStep*& last, const StepInterval& interval) {
  Row* row = rows.data();
  Row* const end = row + rows.size();
  try {
    for (; row != end; ++row) {
      row->progress.plain = 0;
      if (!row->units->step(interval, row->progress)) [[unlikely]]
        break;
      ++row->whole_steps;
      row->last = communication_step_;
    }
  } catch (...) {
    note_plain_ones(*row, interval);
    throw;
  }
  if (row == end) [[likely]] {
    last = &rows.back().steps.back();
    return true;
  }
  note_plain_ones(*row, interval);
  last = &row->steps[row->progress.plain];
  note_step(*last, row->progress.result);
  ++last->steps;
  note_outcome(*last, interval);
  return false;
}

void Stepper::note_plain_ones(Row& row, const StepInterval& interval) {
  for (UnitStep& unit_step : row.steps.first(row.progress.plain)) {
    note_step(unit_step, {.reached = interval.to});
    ++unit_step.steps;
  }
}

void Stepper::note_step(UnitStep& unit_step, const StepResult& result) {
  unit_step.communication_step = communication_step_;
  unit_step.rejections = 0;
  unit_step.result = result;
  exchange_.mark_written(unit_step.component);
}

/// Of the rows of which all units have just reached this time in the present communication step:
/// somebody looks at single ones.
void Stepper::note_whole_rows(Time reached) {
  for (const Row& row : rows_) {
    if (row.last != communication_step_) continue;
    for (UnitStep& unit_step : row.steps) note_step(unit_step, {.reached = reached});
  }
}

void Stepper::count_whole_rows() {
  for (Row& row : rows_) {
    for (UnitStep& unit_step : row.steps) unit_step.steps += row.whole_steps;
    row.whole_steps = 0;
  }
}

}  // namespace stride::core
