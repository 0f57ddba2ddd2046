// Units that step in rows.
#include <utility>
#include <vector>

#include "master/engine/run/stepping/coasting_row.h"
#include "master/engine/run/stepping/stepper.h"

namespace stride::core {

/// Of successive units that are plain. Those whose states are saved are in rows of their own.
void Stepper::form_rows() {
  std::size_t in_rows = 0;
  for (std::size_t first = 0, size = 0; first < unit_steps_.size(); first += size) {
    const std::vector<StepsInARow::Member> members = row_members(first);
    std::unique_ptr<UnitRow> units;
    if (!members.empty()) {
      units = members.front().unit->require_capability<StepsInARow>().make_row(members);
    }
    size = units != nullptr ? units->size() : 1;
    if (units == nullptr) continue;
    const auto steps = std::span(unit_steps_).subspan(first, size);
    if (steps.front().saves_state) units = coasting_row(std::move(units), steps, members);
    rows_.push_back({std::move(units), steps});
    in_rows += size;
  }
  for (Row& row : rows_) {
    row.steps.front().begins_row = true;
    for (UnitStep& unit_step : row.steps) unit_step.row = &row;
  }
  are_all_in_rows_ = in_rows == unit_steps_.size();
}

/// As many units as may be in one row, from this position on.
std::vector<StepsInARow::Member> Stepper::row_members(std::size_t first) const {
  std::vector<StepsInARow::Member> members;
  for (const UnitStep& unit_step : std::span(unit_steps_).subspan(first)) {
    const StepValues* const values = exchange_.fixed_step_values(unit_step.component);
    const bool saves = unit_step.saves_state;
    if (!unit_step.is_plain || values == nullptr || saves != unit_steps_[first].saves_state) break;
    if (saves && unit_step.state->interval().most() == 1) break;  // nothing is noted of it
    if (unit_step.unit->capability<StepsInARow>() == nullptr) break;
    members.push_back({saves ? &unit_step.state->in_row() : unit_step.unit, *values});
  }
  return members;
}

/// `units`, which step so, as they do where their states are saved.
std::unique_ptr<UnitRow> Stepper::coasting_row(std::unique_ptr<UnitRow> units,
                                               std::span<const UnitStep> steps,
                                               std::span<const StepsInARow::Member> members) {
  std::vector<CoastingRow::Member> coasting;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    coasting.push_back({steps[i].state, members[i].values});
  }
  return std::make_unique<CoastingRow>(std::move(units), coasting);
}

/// Returns the first row with a unit of which there is something to record; nullptr if there is
/// none.
[[gnu::always_inline]] inline Stepper::Row* Stepper::step_whole_rows(std::span<Row> rows,
                                                                     const StepInterval& interval) {
  Row* row = rows.data();
  Row* const end = row + rows.size();
  try {
    for (; row != end; ++row) {
      row->progress.plain = 0;
      if (!row->units->step(interval, row->progress)) [[unlikely]]
        return row;
      ++row->whole_steps;
      row->last = communication_step_;
    }
  } catch (...) {
    note_plain_ones(*row, interval);
    throw;
  }
  return nullptr;
}

bool Stepper::advance_regularly(const StepInterval& interval, Time& reached) {
  ++communication_step_;
  early_stop_.by = nullptr;
  has_requests_ = was_parallel_ = is_short_end_ = false;
  step_clock_.measure(false);
  UnitStep* last = nullptr;
  if (are_all_in_rows_ && exchange_.has_all_to_write()) [[likely]] {
    Row* const stopped = step_whole_rows(rows_, interval);
    if (stopped == nullptr) [[likely]]
      return true;
    last = &note_stop_in(*stopped, interval);
  }
  reached = step_one_by_one(interval, true, last);
  if (reached == interval.to && !has_requests_) [[likely]]
    return true;
  reached = make_further_passes(interval, reached);
  return reached == interval.to && !has_requests_;
}

/// As step_plainly(), of the units of successive rows, up to the first one of which there is
/// something to record: returns whether there is none. `last` is the last one that has stepped.
bool Stepper::step_rows(std::span<Row> rows, UnitStep*& last, const StepInterval& interval) {
  Row* const stopped = step_whole_rows(rows, interval);
  last = stopped == nullptr ? &rows.back().steps.back() : &note_stop_in(*stopped, interval);
  return stopped == nullptr;
}

/// Returns the unit of which there is something to record.
Stepper::UnitStep& Stepper::note_stop_in(Row& row, const StepInterval& interval) {
  note_plain_ones(row, interval);
  UnitStep& stopped = row.steps[row.progress.plain];
  note_step(stopped, row.progress.result);
  ++stopped.steps;
  note_outcome(stopped, interval);
  return stopped;
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
