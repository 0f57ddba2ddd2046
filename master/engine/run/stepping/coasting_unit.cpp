#include "master/engine/run/stepping/coasting_unit.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "master/base/state_archive.h"
#include "master/base/wall_clock.h"

namespace stride::core {
CoastingUnit::CoastingUnit(std::unique_ptr<Unit> unit, const UnitDescription& description,
                           SaveInterval interval, std::size_t cache)
    : ForwardingUnit(std::move(unit)),
      state_(inner().require_capability<StateSaving>()),
      concurrent_(inner().capability<ConcurrentSteps>()),
      diagnostics_(inner().capability<UnitDiagnostics>()),
      description_(description),
      interval_(interval),
      cache_(cache) {}

Capability* CoastingUnit::find_capability(CapabilityId id) {
  return find_decorated<StateSaving, ConcurrentSteps>(*this, id);
}

void CoastingUnit::select_state(std::size_t) {
  throw std::logic_error("this kind of unit keeps one state only");
}

void CoastingUnit::persist(StateArchive& state) {
  state.value(counts_.saves);
  state.value(counts_.repeated_steps);
  state.optional(counts_.inexact_repetition, [&](InexactRepetition& repetition) {
    state.value(repetition.time);
    state.value(repetition.variable);
    state.value(repetition.first);
    state.value(repetition.second);
    interval_.limit(1);
  });
}

// ---- What the unit is given ----

void CoastingUnit::set(std::span<const ValueReference> references, const ValueBlock& values) {
  leave_row();
  inner().set(references, values);
  is_continuous_ = is_continuous_ && !is_in_step_ && StepLog::can_add(values);
  if (is_continuous_) log_.add_inputs(references, values);
}

void CoastingUnit::log_inputs(std::span<const BoundValues> inputs) {
  is_continuous_ = is_continuous_ && StepLog::can_add(inputs);
  if (is_continuous_) log_.add_inputs(inputs);
}

/// The step as it is to be made.
StepInterval CoastingUnit::noted(const StepInterval& interval) const {
  StepInterval noted = interval;
  noted.may_go_back_before = is_continuous_ && log_.steps() > 0;
  return noted;
}

void CoastingUnit::log_step(const StepInterval& interval, std::span<const BoundValues> outputs,
                            const StepResult& result) {
  if (result.rejected || !is_continuous_) return;
  log_.add_step(interval, outputs, result);
  keep_outputs(outputs);
}

StepResult CoastingUnit::step(const StepInterval& interval, const StepValues& values) {
  leave_row();
  log_inputs(values.inputs);
  return make_step(interval, values);
}

StepResult CoastingUnit::save_and_step(const StepInterval& interval, const StepValues& values) {
  leave_before_save();
  if (is_save_due() && interval_.begin_single_step()) [[likely]] {
    stretch_ = 1;
    begin_log();
    interval_.count_step();
    return state_.save_with_step(inner(), interval, values);
  }
  StepValues given = values;
  save_behind_inputs(given, false);
  return make_step(interval, given);
}

/// Its inputs are logged, or a part of the state.
inline StepResult CoastingUnit::make_step(const StepInterval& interval, const StepValues& values) {
  interval_.count_step();
  if (!is_continuous_ && !is_measured_) [[likely]]
    return inner().step(interval, values);
  const StepInterval step = noted(interval);
  is_in_step_ = true;
  const bool is_measured = std::exchange(is_measured_, false);
  const auto began = is_measured ? interval_.now()() : WallClock::Source::time_point();
  const StepResult result = inner().step(step, values);
  if (is_measured) interval_.add_costs(save_cost_, interval_.now()() - began);
  is_in_step_ = false;
  log_step(step, values.outputs, result);
  return result;
}

/// save_state() behind these inputs, as far as it is not left to the step of a unit that steps
/// elsewhere. Returns whether it is; the inputs that are still to be set remain in `values`.
bool CoastingUnit::save_behind_inputs(StepValues& values, bool may_save_elsewhere) {
  const bool can_log = StepLog::can_add(values.inputs);
  is_continuous_ = is_continuous_ && can_log;
  bool is_left = false;
  if (is_save_due()) {
    choose_stretch();
    is_left = may_save_elsewhere && !is_measured_;
    if (!is_left && !can_log) {
      for (const BoundValues& input : values.inputs) inner().set(input.references, *input.block);
      values.inputs = {};
    }
    if (!is_left) save_measured();
    begin_log();
  }
  if (can_log) log_.add_inputs(values.inputs);
  note_save();
  return is_left;
}

// ---- A step elsewhere ----

void CoastingUnit::begin_step(const StepInterval& interval, const StepValues& values,
                              const Extras& extras) {
  leave_row();
  StepValues given = values;
  const bool saves = extras.saves_state && save_behind_inputs(given, true);
  if (!extras.saves_state) log_inputs(values.inputs);
  interval_.count_step();
  step_ = PresentStep{noted(interval), values.outputs, std::exchange(is_measured_, false)};
  is_in_step_ = true;
  concurrent_->begin_step(
      step_->interval, given,
      {.saves_state = saves, .is_timed = extras.is_timed || step_->is_measured});
}

StepResult CoastingUnit::finish_step() {
  const StepResult result = concurrent_->finish_step();
  is_in_step_ = false;
  const PresentStep step = *std::exchange(step_, std::nullopt);
  if (step.is_measured) interval_.add_costs(save_cost_, concurrent_->step_time());
  log_step(step.interval, step.outputs, result);
  return result;
}

void CoastingUnit::enter_event_mode() {
  drop_row();
  inner().enter_event_mode();
}

// ---- Its states ----

void CoastingUnit::save_state() {
  leave_row();
  if (is_save_due()) return begin_stretch();
  note_save();
}

/// Of a state that is not saved.
void CoastingUnit::note_save() {
  if (log_.steps() > mark_.steps) std::swap(at_mark_, latest_);
  mark_ = log_.mark();
}

void CoastingUnit::begin_stretch() {
  choose_stretch();
  save_measured();
  begin_log();
}

void CoastingUnit::choose_stretch() {
  if (!is_log_bounded_ && log_.steps() > 0) bound_log();
  stretch_ = interval_.begin_stretch();
  is_measured_ = interval_.is_measured();
}

/// Behind a save.
void CoastingUnit::begin_log() {
  ++counts_.saves;
  log_.clear();
  mark_ = {};
  is_continuous_ = stretch_ > 1;
}

void CoastingUnit::save_measured() {
  if (!is_measured_) return state_.save_state();
  const auto now = interval_.now();
  const auto before = now();
  const auto began = now();
  state_.save_state();
  save_cost_ = now() - began - (began - before);  // a reading may take longer than the save
}

/// From the first steps in it follows what it can be: later ones allocate nothing.
void CoastingUnit::bound_log() {
  is_log_bounded_ = true;
  interval_.limit(kMostBytes * log_.steps() / log_.size());
  interval_.set_near(cache_ * log_.steps() / log_.size());
  log_.reserve(interval_.most() / log_.steps() + 1);
}

/// Inputs that were set since the state was saved are a part of what is restored.
void CoastingUnit::restore_state() {
  count_rollback();
  leave_row();
  state_.restore_state();
  log_.cut(mark_);
  is_continuous_ = stretch_ > 1;
  if (log_.steps() == 0) return log_.set_inputs(inner());
  set_repeating(true);
  repeat();
  set_repeating(false);
  begin_stretch();
}

void CoastingUnit::set_repeating(bool repeating) {
  if (diagnostics_ != nullptr) diagnostics_->set_repeating(repeating);
}

void CoastingUnit::repeat() {
  const bool is_same = log_.repeat(inner(), [&] { compare_outputs(); });
  counts_.repeated_steps += log_.steps();
  if (!is_same && !counts_.inexact_repetition) {
    counts_.inexact_repetition = {log_.end(), "", "", ""};
  }
  if (counts_.inexact_repetition) interval_.limit(1);
}

void CoastingUnit::keep_outputs(std::span<const BoundValues> outputs) {
  const bool is_first = latest_.values.size() != outputs.size();
  latest_.read = outputs;
  if (is_first) latest_.values.resize(outputs.size(), ValueBlock(ValueType::Float64, 0));
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (is_first || outputs[i].float64s.empty()) {
      latest_.values[i] = *outputs[i].block;
    } else {  // as most are
      std::ranges::copy(outputs[i].float64s, latest_.values[i].numbers<double>().begin());
    }
  }
}

/// Those of a unit in a row: of one block, if it has any.
void CoastingUnit::keep_outputs(std::span<const double> outputs) {
  if (!latest_.values.empty()) {
    std::ranges::copy(outputs, latest_.values.front().numbers<double>().begin());
  }
}

void CoastingUnit::compare_outputs() {
  for (std::size_t i = 0; i < at_mark_.read.size() && !counts_.inexact_repetition; ++i) {
    const ValueBlock& before = at_mark_.values[i];
    if (before == *at_mark_.read[i].block) continue;
    for (std::size_t k = 0; k < before.size(); ++k) {
      if (is_same(before, k, *at_mark_.read[i].block, k)) continue;
      note_difference(at_mark_.read[i], k, before);
      break;
    }
  }
}

void CoastingUnit::note_difference(const BoundValues& output, std::size_t element,
                                   const ValueBlock& before) {
  std::size_t end = 0;
  for (const ValueReference reference : output.references) {
    const Variable& variable = description_.variables[*description_.find(reference)];
    end += variable.size;
    if (element >= end) continue;
    counts_.inexact_repetition = {log_.end(), variable.name, element_text(before, element),
                                  element_text(*output.block, element)};
    return;
  }
}

}  // namespace stride::core
