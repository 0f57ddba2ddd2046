// The end of a step of an FMI 2.0 unit: asynchronous steps, and steps that were completed in part.
#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/loader/fmu/fmi2/fmi2_unit.h"

namespace stride::importer {
namespace {

constexpr const char* kFmi2LastSuccessfulTime = "fmi2LastSuccessfulTime";

}  // namespace

Status Fmi2Unit::do_step(CallSequence& calls, const core::StepInterval& interval, double size) {
  if (callbacks_.stepFinished != nullptr) asynchronous_.begin();
  // noSetFMUStatePriorToCurrentPoint
  const fmi2Boolean never_goes_back = !(options_.may_go_back || interval.may_go_back_before);
  const Status status = calls.call_discardable("fmi2DoStep", fmi_.DoStep, interval.begin_seconds,
                                               size, never_goes_back);
  return status == Status::Pending ? wait_for_step() : status;
}

// ---- Asynchronous steps ----

void Fmi2Unit::on_step_finished(fmi2ComponentEnvironment environment, fmi2Status status) {
  with_receiver<Fmi2Unit>(environment,
                          [&](Fmi2Unit& unit) { unit.asynchronous_.finish(status_of(status)); });
}

/// Polls with growing pauses, since not every unit calls back.
Status Fmi2Unit::wait_for_step() {
  using namespace std::chrono_literals;
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::microseconds kLongestPause = 5ms;
  const Clock::time_point began = Clock::now();
  Status status = Status::Pending;
  for (auto pause = 20us; status == Status::Pending; pause = std::min(pause * 2, kLongestPause)) {
    if (options_.interrupted != nullptr && *options_.interrupted != 0) cancel_step();
    write_note("fmi2DoStep");  // whose work goes on
    status = asynchronous_.wait(pause).value_or(Status::Pending);
    if (status == Status::Pending) status = poll_step();
    const bool is_long = !has_slow_step_warning_ && Clock::now() - began > options_.warn_after;
    if (status != Status::Pending || !is_long) continue;
    has_slow_step_warning_ = true;
    warn(
        fmt::format("the unit has not finished its step from {} s yet (fmi2Pending){}; stride "
                    "waits for it",
                    core::to_text(*time_), pending_text()));
  }
  end_call();
  return check_status("fmi2DoStep", status);
}

/// A step may never end, so it ends with the run. No other function but the one that frees the unit
/// is called then.
void Fmi2Unit::cancel_step() {
  if (fmi_.CancelStep != nullptr) {
    write_note("fmi2CancelStep");
    static_cast<void>(fmi_.CancelStep(instance_));
  }
  end_call();
  failed_in_ = "fmi2DoStep";
  fail(
      fmt::format("the run was interrupted before the unit had finished its step from {} s "
                  "(fmi2Pending); the results up to there are complete",
                  core::to_text(*time_)));
}

/// The unit's messages are those of the step, so this call's own status is not checked.
Status Fmi2Unit::poll_step() {
  if (fmi_.GetStatus == nullptr) return Status::Pending;
  note_call("fmi2GetStatus");
  fmi2Status of_step = fmi2Pending;
  const auto answer = static_cast<Status>(fmi_.GetStatus(instance_, fmi2DoStepStatus, &of_step));
  const bool is_known = answer == Status::Ok || answer == Status::Warning;
  const bool is_unknown = answer == Status::Discard || answer == Status::Pending;
  if (!is_known && !is_unknown) fail_call("fmi2GetStatus", answer);
  if (answer == Status::Discard && !attributes_->can_run_asynchronously) {
    fail(
        "fmi2DoStep returned fmi2Pending, which a unit without canRunAsynchronuously may not, and "
        "fmi2GetStatus does not know how the step goes on",
        "let the unit make its steps before fmi2DoStep returns, or declare "
        "canRunAsynchronuously and answer fmi2GetStatus(fmi2DoStepStatus)");
  }
  const Status step = status_of(of_step);
  if (is_unknown || step == Status::Pending) return Status::Pending;
  asynchronous_.note_polled();
  return step;
}

/// The unit's message about a step that is not finished.
std::string Fmi2Unit::pending_text() {
  if (fmi_.GetStringStatus == nullptr) return "";
  note_call("fmi2GetStringStatus");
  fmi2String text = nullptr;
  const fmi2Status answer = fmi_.GetStringStatus(instance_, fmi2PendingStatus, &text);
  return answer == fmi2OK && text != nullptr ? fmt::format("; message of the unit: {}", text) : "";
}

// ---- Partial steps (FMI 2.0, 4.2.2 and 4.2.3) ----

core::StepResult Fmi2Unit::handle_discard(const core::StepInterval& interval) {
  take_rejection_reason("fmi2DoStep");
  const std::optional<double> seconds = last_successful_time();
  const std::optional<Time> reached = instant_within(interval, seconds, kFmi2LastSuccessfulTime);
  if (requests_termination()) return accept_termination(interval, reached);
  if (!saves_each_step_) {
    if (!reached || *reached == interval.from) fail_partial_step(interval, seconds);
    return accept_partial_step(interval, *reached);
  }
  restore(is_as_saved_ ? states_.chosen() : before_step_);
  return {.rejected = true, .reached = reached.value_or(interval.from)};
}

/// The step ends where the unit requested the end of the simulation; if that time is unknown, the
/// step is undone.
core::StepResult Fmi2Unit::accept_termination(const core::StepInterval& interval,
                                              std::optional<Time> reached) {
  if (!reached) {
    if (!saves_each_step_) {
      fail(
          "the unit ended the simulation within its step (fmi2Terminated), and does not report "
          "when (fmi2LastSuccessfulTime)");
    }
    restore(is_as_saved_ ? states_.chosen() : before_step_);
    reached = interval.from;
  }
  return {
      .early_return = *reached != interval.to, .terminate_simulation = true, .reached = *reached};
}

void Fmi2Unit::fail_partial_step(const core::StepInterval& interval,
                                 std::optional<double> seconds) const {
  fail_discarded(interval, "fmi2DoStep returned fmi2Discard",
                 how_far(interval, seconds, kFmi2LastSuccessfulTime),
                 "its state was not saved, since it cannot be (canGetAndSetFMUstate)",
                 "try a smaller step, or use a unit that can save its state");
}

/// For a unit whose state before the step was not saved.
core::StepResult Fmi2Unit::accept_partial_step(const core::StepInterval& interval, Time reached) {
  if (!std::exchange(has_discard_warning_, true)) {
    warn(
        fmt::format("the step to {} s ended at {} s (fmi2Discard), and the unit's state cannot be "
                    "restored (canGetAndSetFMUstate), so all go on from there, here and in later "
                    "steps; FMI 2.0 allows such a unit to be ended only, so look at its results",
                    core::to_text(interval.to), core::to_text(reached)));
  }
  return {.early_return = reached != interval.to, .reached = reached};
}

/// Returns whether the unit has an answer.
template <class Function, class Value>
bool Fmi2Unit::query_status(const char* name, Function* function, fmi2StatusKind kind,
                            Value* value) {
  if (function == nullptr) return false;
  const Status status = call_discardable(name, function, kind, value);
  if (has_messages()) drop_messages();  // of why it has none
  return status == Status::Ok || status == Status::Warning;
}

/// In seconds; nothing if it is not known.
std::optional<double> Fmi2Unit::last_successful_time() {
  double seconds = 0;
  const bool is_known =
      query_status("fmi2GetRealStatus", fmi_.GetRealStatus, fmi2LastSuccessfulTime, &seconds);
  return is_known ? std::optional(seconds) : std::nullopt;
}

bool Fmi2Unit::requests_termination() {
  fmi2Boolean wants = fmi2False;
  return query_status("fmi2GetBooleanStatus", fmi_.GetBooleanStatus, fmi2Terminated, &wants) &&
         wants != fmi2False;
}

// ---- Inputs within a step ----

/// The input update sets inputs at three instants, and these are its.
void Fmi2Unit::set_input_derivatives(double size) {
  struct Sampling {
    explicit Sampling(Fmi2Unit& owner) : unit(owner) {
      unit.sampled_inputs_ = &unit.input_derivatives_;
    }
    ~Sampling() { unit.sampled_inputs_ = nullptr; }
    Fmi2Unit& unit;
  };
  {
    const Sampling sampling(*this);
    for (int k = 0; k < InputDerivatives::kSamples; ++k) {
      input_derivatives_.begin_sample(k);
      input_update_(InputDerivatives::instant(k, size));
    }
  }
  input_derivatives_.compute(size);
  const auto& references = input_derivatives_.references();
  if (references.empty()) return;
  require("fmi2SetRealInputDerivatives", fmi_.SetRealInputDerivatives, "canInterpolateInputs");
  call("fmi2SetRealInputDerivatives", fmi_.SetRealInputDerivatives, references.data(),
       references.size(), input_derivatives_.orders().data(), input_derivatives_.values().data());
}

}  // namespace stride::importer
