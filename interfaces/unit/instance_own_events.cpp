// An instance that is used without Event Mode handles its events itself (FMI 3.0, 4.2.1,
// eventModeUsed = fmi3False), at their instants: a communication step becomes several steps of the
// unit with events in between. What clocks carry cannot reach or leave it then, which is logged.
#include <algorithm>
#include <stdexcept>

#include "interfaces/unit/instance.h"
#include "interfaces/unit/xml_writer.h"

namespace stride::kit {
namespace {

constexpr int kMostIterations = 1000;  // as many as the master allows

}  // namespace

/// The event at the start, which an importer with Event Mode would handle now.
void Instance::begin_own_events() {
  if (!table_->input_clocks().empty()) {
    warn_of_clocks(Causality::Input, warned_of_inputs_,
                   "input clocks never tick, and what belongs to them stays as it is");
  }
  if (handle_own_events()) {
    throw std::runtime_error("the unit requests the end of the simulation before its first step");
  }
}

/// Events at this instant, to a fixed point. Returns whether the unit requests the end of the
/// simulation.
bool Instance::handle_own_events() {
  event_pending_ = false;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    if (any_clock_ticked()) {
      const std::string lost = "output clocks tick unheard, and what belongs to them is lost";
      warn_of_clocks(Causality::Output, warned_of_outputs_,
                     lost + ", the first time at " + to_text(time_) + " s");
    }
    const UpdateOutcome outcome = update_discrete_states();
    if (outcome.terminate) return true;
    if (!outcome.iterate && !event_is_due()) return false;
  }
  throw std::runtime_error("the events at " + to_text(time_) + " s do not settle");
}

Instance::StepOutcome Instance::step_through_events(Time to) {
  std::optional<SavedState> before;
  if (unit_->info().may_reject && unit_->lists_state()) save(before.emplace());
  const Time from = time_;
  const auto outcome = [&](bool terminate) {
    const bool early = time_ < to && importer_.early_return_allowed;
    return StepOutcome{nullptr, false, terminate, early, time_seconds_};
  };
  for (int standing = 0; standing < kMostIterations;) {
    if (event_is_due() && handle_own_events()) return outcome(true);
    if (time_ >= to) return outcome(false);
    const Time start = time_;
    const Time target = next_event_ ? std::min(*next_event_, to) : to;
    if (start > from || target < to) {
      step_point_ = to_seconds(start);
      step_size_ = to_seconds(target - start);
    }
    const Step step = step_to(target, true);
    if (step.rejection()) {
      if (before || start > from) undo(*step.rejection(), before);
      return rejected(*step.rejection());
    }
    if (step.terminates()) {
      if (event_is_due()) handle_own_events();
      return outcome(true);
    }
    if (time_ < target && !event_pending_ && importer_.early_return_allowed) return outcome(false);
    standing = time_ > start ? 0 : standing + 1;
  }
  throw std::runtime_error("step() returns early at " + to_text(time_) + " s again and again");
}

/// fmi3Discard leaves the unit as it was before the step.
void Instance::undo(const std::string& rejection, const std::optional<SavedState>& before) {
  if (!before) {
    throw std::runtime_error("the unit rejects the rest of the step at " + to_text(time_) + " s (" +
                             rejection +
                             "), behind an event that it cannot undo, because it has no state to "
                             "be saved; use Event Mode, or shorter steps");
  }
  restore(*before);
}

/// Logs once what an importer without Event Mode misses. This is not debug logging, so it does not
/// depend on log categories.
void Instance::warn_of_clocks(Causality causality, bool& warned, const std::string& consequence) {
  if (warned || importer_.log == nullptr) return;
  warned = true;
  std::string clocks;
  for (const Variable& row : unit_->variables()) {
    if (row.type != Type::Clock || row.causality != causality) continue;
    clocks += (clocks.empty() ? "'" : ", '") + row.name + "'";
  }
  const std::string message =
      "the importer does not use Event Mode: " + consequence + " (" + clocks + ")";
  importer_.log(importer_.environment, fmi3Warning, name(LogWarnings), message.c_str());
}

}  // namespace stride::kit
