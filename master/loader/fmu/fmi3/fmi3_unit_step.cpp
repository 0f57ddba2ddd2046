// How a unit of FMI 3.0 steps.
#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/loader/fmu/fmi3/fmi3_unit.h"
#include "master/loader/fmu/fmi3/fmi3_unit_row.h"

namespace stride::importer {
namespace {

/// Either of the two that a double may be after the step.
bool is_exact_end(const core::StepInterval& interval, double seconds) {
  const double sum = interval.begin_seconds + interval.size_seconds;
  return (seconds == interval.end_seconds) | (seconds == sum);  // no branch: either is likely
}

}  // namespace

// Most values are of this type.
[[gnu::always_inline]] inline void Fmi3Unit::get_reals(CallSequence& calls,
                                                       const core::BoundValues& values) {
  calls.call("fmi3GetFloat64", fmi_.GetFloat64, values.references.data(), values.references.size(),
             values.float64s.data(), values.float64s.size());
}

[[gnu::always_inline]] inline void Fmi3Unit::set_reals(CallSequence& calls,
                                                       const core::BoundValues& values) {
  calls.call("fmi3SetFloat64", fmi_.SetFloat64, values.references.data(), values.references.size(),
             values.float64s.data(), values.float64s.size());
}

[[gnu::always_inline]] inline void Fmi3Unit::set(CallSequence& calls, const core::StepValues& all) {
  for (const core::BoundValues& values : all.inputs) {
    values.float64s.empty() ? set(values.references, *values.block) : set_reals(calls, values);
  }
}

core::StepResult Fmi3Unit::step(const core::StepInterval& interval,
                                const core::StepValues& values) {
  CallSequence calls(*this, "fmi3DoStep", interval.from);
  set(calls, values);
  return step_behind_inputs(calls, interval, values);
}

core::StepResult Fmi3Unit::save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                          const core::StepValues& values) {
  if (&unit != this) return StateSaving::save_with_step(unit, interval, values);
  CallSequence calls(*this, "fmi3DoStep", interval.from);
  set(calls, values);
  Fmi3Unit::save_state();
  return step_behind_inputs(calls, interval, values);
}

[[gnu::always_inline]] inline core::StepResult Fmi3Unit::step_behind_inputs(
    CallSequence& calls, const core::StepInterval& interval, const core::StepValues& all) {
  const double size = size_of(interval);
  if (!(size > 0)) [[unlikely]] {  // to the unit, whose time is a double, it is the same instant
    calls.set_time(interval.to);
    return {.reached = interval.to};
  }
  core::StepResult other;
  const bool is_plain = do_step(calls, interval, size, time_tolerance(interval), other);
  if (!is_plain && other.rejected) [[unlikely]]
    return other;
  for (const core::BoundValues& values : all.outputs) {
    values.float64s.empty() ? get(values.references, *values.block) : get_reals(calls, values);
  }
  if (!is_plain) [[unlikely]]
    return other;
  return {.reached = interval.to};
}

/// Returns whether the step has just reached its end. If not, `result` is how it has ended.
[[gnu::always_inline]] inline bool Fmi3Unit::do_step(CallSequence& calls,
                                                     const core::StepInterval& interval,
                                                     double size, double tolerance,
                                                     core::StepResult& result) {
  StepAnswer answer{.last_successful = interval.end_seconds};
  step_point_ = interval.begin_seconds;
  // noSetFMUStatePriorToCurrentPoint
  const fmi3Boolean never_goes_back = !(options_.may_go_back || interval.may_go_back_before);
  const Status status = calls.call_discardable(
      "fmi3DoStep", fmi_.DoStep, interval.begin_seconds, size, never_goes_back, &answer.needs_event,
      &answer.terminate, &answer.early, &answer.last_successful);
  const bool is_plain = is_plain_end(interval, status, answer, tolerance);
  if (!is_plain) [[unlikely]] {
    result = evaluate(interval, status, answer);
    if (result.rejected) return false;
  }
  was_restored_ = false;
  calls.set_time(is_plain ? interval.to : result.reached);
  return is_plain;
}

/// Of a step that did not just reach its end.
core::StepResult Fmi3Unit::evaluate(const core::StepInterval& interval, Status status,
                                    const StepAnswer& answer) {
  rethrow_callback_failure();
  if (status == Status::Discard) {
    take_rejection_reason("fmi3DoStep");
    return {.rejected = true, .reached = interval.from};
  }
  if (answer.needs_event && !parts_.description->has_event_mode)
    fail("fmi3DoStep returned eventHandlingNeeded, and the unit has no Event Mode (hasEventMode)");
  if (!answer.early) compare_times(interval, answer.last_successful);
  return {.early_return = answer.early,
          .event_handling_needed = answer.needs_event,
          .terminate_simulation = answer.terminate,
          .reached = answer.early ? reached_early(interval, answer.last_successful) : interval.to};
}

// ---- Steps in a row ----

bool Fmi3Unit::can_be_in_row(const Member& member) const {
  const auto has_other_type = [](const core::BoundValues& values) {
    return values.block->type() != core::ValueType::Float64;
  };
  const auto [inputs, outputs] = member.values;
  return row_ == nullptr && !present_.has_note() && !input_update_ && mode_.is_usual() &&
         fmi_.SetFloat64 != nullptr && fmi_.GetFloat64 != nullptr && fmi_.DoStep != nullptr &&
         inputs.size() <= 1 && outputs.size() <= 1 &&
         std::ranges::none_of(inputs, has_other_type) &&
         std::ranges::none_of(outputs, has_other_type);
}

std::unique_ptr<core::UnitRow> Fmi3Unit::make_row(std::span<const Member> members) {
  const auto can_be_in_it = [&](const Member& member) {
    const auto* const unit = dynamic_cast<const Fmi3Unit*>(member.unit);
    return unit != nullptr && unit->can_be_in_row(member) && unit->mode_ == mode_;
  };
  const auto end = std::ranges::find_if_not(members, can_be_in_it);
  if (end == members.begin()) return nullptr;
  return std::make_unique<Row>(std::span(members.begin(), end));
}

// ---- Inputs within a step ----

void Fmi3Unit::on_intermediate_update(fmi3InstanceEnvironment environment, fmi3Float64 time,
                                      fmi3Boolean set_requested, fmi3Boolean, fmi3Boolean,
                                      fmi3Boolean, fmi3Boolean* early_return_requested,
                                      fmi3Float64*) {
  if (early_return_requested != nullptr) *early_return_requested = fmi3False;
  if (!set_requested) return;
  if (auto* const unit = find_caller<Fmi3Unit>(environment)) unit->update_inputs(time);
}

/// Nothing may cross the unit's C code: step() throws what goes wrong here.
void Fmi3Unit::update_inputs(double time) noexcept {
  if (!input_update_ || callback_failure_) return;
  const core::ProcessorModeScope mode(mode_);  // the unit may have one for its step
  try {
    input_update_(time - step_point_);
  } catch (...) {
    callback_failure_ = std::current_exception();
  }
  write_note("fmi3DoStep");  // which goes on, whatever was called meanwhile
}

/// FMI 3.0, 4.2: a unit with a fixed internal step may end at another time than that of the step.
void Fmi3Unit::compare_times(const core::StepInterval& interval, double last_successful) {
  if (is_end(interval, last_successful)) return;
  checked_time(last_successful, "lastSuccessfulTime");
  if (std::exchange(has_time_warning_, true)) return;
  const auto& internal_step = parts_.description->fixed_internal_step;
  warn(fmt::format(
      "the step to {} s ended at the unit's own time {} s (lastSuccessfulTime) without "
      "an early return{}; its outputs are taken as those at {} s, here and in later "
      "steps",
      core::to_text(interval.to), last_successful,
      internal_step
          ? fmt::format(", since its fixedInternalStepSize is {} s", core::to_text(*internal_step))
          : "",
      core::to_text(interval.to)));
}

Time Fmi3Unit::reached_early(const core::StepInterval& interval, double last_successful) const {
  if (is_exact_end(interval, last_successful)) return interval.to;
  if (!options_.early_return_allowed) {
    fail("fmi3DoStep returned early, which was not allowed at its instantiation");
  }
  if (!is_within(interval, last_successful)) {
    fail(fmt::format("fmi3DoStep returned early at {} s, which is outside of the step to {} s",
                     last_successful, core::to_text(interval.to)));
  }
  return std::clamp(checked_time(last_successful, "lastSuccessfulTime"), interval.from,
                    interval.to);
}

}  // namespace stride::importer
