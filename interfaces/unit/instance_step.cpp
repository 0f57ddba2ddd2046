// The step of an instance (FMI 3.0, 4.2): what the importer may ask for, and what the unit may do.
#include <algorithm>
#include <cmath>
#include <limits>

#include "interfaces/unit/instance.h"
#include "interfaces/unit/xml_writer.h"

namespace stride::kit {
namespace {

/// How far apart two readings of the same instant may be: after two and a half hours a double is
/// coarser than a picosecond.
Duration rounding(double seconds) {
  const double picoseconds = 4 * std::numeric_limits<double>::epsilon() * std::abs(seconds) * 1e12;
  return Duration(1 + static_cast<Picoseconds>(picoseconds));
}

bool are_near(Time one, Time other, Duration distance) {
  return std::chrono::abs(one - other) <= distance;
}

}  // namespace

/// The event that the unit has announced for the end of a step, where doubles are coarser than
/// picoseconds: the importer knows its time as a double only.
inline Time Instance::meant_end(double end, Time to) const {
  constexpr double kPicosecondsDiffer = 8192;
  if (!next_event_ || std::abs(end) < kPicosecondsDiffer) return to;
  const double event = to_seconds(*next_event_);
  const bool is_meant = std::nextafter(event, end) == end && *next_event_ > time_;
  return is_meant ? *next_event_ : to;
}

/// A size that is the difference of two points leads to the second one without rounding. Any other
/// is a duration of its own, which counts from the exact time: from 4096 s on the rounded sum can
/// be another picosecond.
inline Time Instance::end_of_step(double point, double size) const {
  const double end = point + size;
  const bool is_difference = end - point == size;
  const bool is_from_here = point == time_seconds_ && size > 0 && size <= kMaxSeconds;
  if (is_difference || !is_from_here || end > kMaxSeconds) return meant_end(end, checked_time(end));
  return meant_end(end, later(time_, duration_from_seconds(size)));
}

inline bool Instance::is_here(double point) const {
  return point == time_seconds_ || are_near(checked_time(point), time_, rounding(point));
}

inline void Instance::check_step(double point, double size, Time to) const {
  if (!is_here(point)) {
    refuse([=] {
      return "the unit is at " + to_text(time_) + " s, but the step starts at " +
             to_text(checked_time(point)) + " s";
    });
  }
  if (!(size > 0) || to <= time_) {
    refuse([] { return "the communication step size must be positive"; });
  }
  if (size > kMaxSeconds) {
    refuse([] {
      return "the communication step size must be at most " + to_text(kMaxSeconds) + " s";
    });
  }
  if (stop_ && to > *stop_ && to > *stop_ + rounding(point + size)) {
    refuse([=] {
      return "the step ends at " + to_text(to) + " s, behind the stop time " + to_text(*stop_) +
             " s";
    });
  }
}

Instance::StepOutcome Instance::do_step(double point, double size) {
  const Time to = end_of_step(point, size);
  check_step(point, size, to);
  step_point_ = point;
  step_size_ = size;
  StepOutcome outcome = is_one_step(to) ? step_once(to) : step_through_events(to);
  if (time_ == to) outcome.reached = point + size;
  return outcome;
}

/// With Event Mode a step of the importer is one of the unit. Without it most are: those of units
/// that make each step to its end, with no event before that.
inline bool Instance::is_one_step(Time to) const {
  if (importer_.event_mode_used) return true;
  const UnitInfo& info = unit_->info();
  const bool has_event = event_is_due() || (next_event_ && *next_event_ < to);
  return !has_event && !info.may_reject && !info.early_return;
}

inline Instance::StepOutcome Instance::step_once(Time to) {
  const bool has_own_events = !importer_.event_mode_used;
  const Step step = step_to(to, has_own_events || importer_.early_return_allowed);
  if (step.rejection()) return rejected(*step.rejection());
  const bool event_terminates = has_own_events && event_is_due() && handle_own_events();
  const bool terminates = step.terminates() || event_terminates;
  return {nullptr, event_pending_, terminates, time_ < to, time_seconds_};
}

Instance::StepOutcome Instance::rejected(const std::string& reason) {
  rejection_ = reason;
  return {&rejection_, false, false, false, time_seconds_};
}

/// The unit's own step, from its present instant.
Step Instance::step_to(Time to, bool may_return_early) {
  for (Clock* clock : table_->output_clocks()) clock->clear();
  const bool can_update =
      importer_.intermediate_update != nullptr && !importer_.intermediate_variables.empty();
  Step step(time_, to, may_return_early, can_update ? this : nullptr);
  unit_->step(step);
  if (step.rejection() || step.reached()) check_outcome(step);
  if (step.rejection()) return step;
  set_time(step.reached().value_or(to));
  event_pending_ = step.event_needed() || any_clock_ticked();
  return step;
}

/// What the unit did must be what it has declared and what the importer allows.
void Instance::check_outcome(const Step& step) const {
  if (step.rejection()) {
    if (unit_->info().may_reject) return;
    throw std::logic_error("step() rejected the step (" + *step.rejection() +
                           "), but the unit did not declare may_reject");
  }
  const Time reached = step.reached().value_or(step.to());
  if (reached < time_ || reached > step.to()) {
    throw std::logic_error("step() returned early at an instant outside of the step");
  }
  if (reached == step.to()) return;
  if (!unit_->info().early_return) {
    throw std::logic_error("step() returned early, but the unit did not declare early_return");
  }
  if (!step.early_return_allowed()) {
    throw std::logic_error("step() returned early, which the importer does not allow");
  }
}

/// Gives the importer occasion to set its intermediate inputs (FMI 3.0, 4.2.2). It is always free
/// to be called for an earlier instant, since no instant is known to be finished.
void Instance::update_inputs(double seconds_into_step) {
  const double rounding = 1e-9 * step_size_;
  if (!(seconds_into_step >= -rounding && seconds_into_step <= step_size_ + rounding)) {
    throw std::logic_error("step() asked for the inputs at " + to_text(seconds_into_step) +
                           " s after the beginning of a step of " + to_text(step_size_) + " s");
  }
  const double time =
      std::min(std::max(step_point_ + seconds_into_step, step_point_), step_point_ + step_size_);
  mode_ = IntermediateUpdateMode;
  struct Guard {
    Mode& mode;
    ~Guard() { mode = StepMode; }
  } guard{mode_};  // the importer may be C++ and throw
  fmi3Boolean early_return_requested = fmi3False;
  fmi3Float64 early_return_time = 0;
  importer_.intermediate_update(importer_.environment, time, fmi3True, fmi3False, fmi3False,
                                fmi3False, &early_return_requested, &early_return_time);
}

}  // namespace stride::kit
