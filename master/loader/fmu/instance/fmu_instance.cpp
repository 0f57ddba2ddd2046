#include "master/loader/fmu/instance/fmu_instance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>
#include <unistd.h>

#include "master/base/text/readable_text.h"
#include "master/base/time_text.h"
#include "master/engine/model/system/own_step.h"
#include "master/engine/model/time/grid.h"
#include "master/loader/fmu/instance/state_hint.h"

namespace stride::importer {
namespace {

/// Python's interpreter does so when it begins, without harm once it is put back.
bool is_of_interpreter(const std::string& change) {
  constexpr const char* kOfPython[] = {"the locale", "the handler of SIGPIPE",
                                       "the handler of SIGXFSZ", "the handler of SIGINT"};
  return std::ranges::find(kOfPython, change) != std::end(kOfPython);
}

constexpr std::size_t kMaxMessages = 8;

template <class Predicate>
bool has_variable(const core::UnitDescription& unit, Predicate&& predicate) {
  return std::ranges::any_of(unit.variables, predicate);
}

}  // namespace

bool declares(const core::UnitDescription& unit, core::CapabilityId id) {
  using core::CapabilityId;
  switch (id) {
    case CapabilityId::Resetting:
    case CapabilityId::UnitDiagnostics:
      return true;
    case CapabilityId::ConfigurationMode:
      return has_variable(unit, [](const core::Variable& variable) {
        return variable.causality == core::Causality::StructuralParameter;
      });
    case CapabilityId::StateSaving:
      return unit.can_save_state || unit.can_serialize_state;
    case CapabilityId::StateSerialization:
      return unit.can_serialize_state;
    case CapabilityId::IdlePromises:
      return unit.promises_idle;
    case CapabilityId::DirectionalDerivatives:
      return unit.provides_directional_derivatives;
    case CapabilityId::ClockIntervals:
      return has_variable(unit, std::mem_fn(&core::Variable::is_time_based_clock));
    case CapabilityId::InputsWithinStep:
      return unit.provides_intermediate_update;
    case CapabilityId::MessageText:
    case CapabilityId::HostDiagnostics:
    case CapabilityId::ConcurrentSteps:
    case CapabilityId::StepsInARow:
    case CapabilityId::End:
      return false;
  }
  return false;
}

FmuInstance::FmuInstance(const char* prefix, std::shared_ptr<const SharedLibrary> library,
                         std::string name, UnitParts parts, InstanceOptions options)
    : present_(name, options.where, options.call_note),
      is_unusable_(library->is_unusable()),
      name_(std::move(name)),
      parts_(std::move(parts)),
      options_(std::move(options)),
      prefix_(prefix),
      library_(std::move(library)) {
  static const int registered = ::pthread_atfork(nullptr, nullptr, &FmuInstance::note_fork);
  (void)registered;
  begin_receiving();
}

FmuInstance::~FmuInstance() {
  end_receiving();
  if (notices_ != 0) --noticed_;
}

// ---- Calls and failures ----

Status FmuInstance::check_status(const char* name, Status status) {
  if (status == Status::Discard || (status == Status::Pending && may_be_pending())) return status;
  if (status != Status::Ok && status != Status::Warning) fail_call(name, status);
  if (has_messages()) drop_messages();
  return status;
}

Status FmuInstance::check_left(const char* name, Status status) {
  if (is_copy_of_process()) leave_fork(name);
  return check_status(name, status);
}

void FmuInstance::check_left_by_whole_call(const char* name, Status status) {
  status = check_left(name, status);
  if (status == Status::Discard || status == Status::Pending) fail_call(name, status);
}

void FmuInstance::fail_not_callable(const char* name) const {
  if (failed_in_ != nullptr) {
    fail(fmt::format("{} cannot be called, because {} has failed before", name, failed_in_));
  }
  throw core::ConsequentError(
      core::Error::Kind::Run, {.where = options_.where, .unit = name_, .time = time()},
      fmt::format("{} cannot be called, because an instance of the same FMU has returned "
                  "{}Fatal before",
                  name, prefix_));
}

void FmuInstance::fail_call(const char* function, Status status) {
  failed_in_ = function;
  if (status == Status::Fatal) mark_unusable();
  if (callback_failure_) log_held();
  rethrow_callback_failure();  // it is the cause of what the unit answered
  const std::string hint = hint_for(function, status);
  fail(failure_of(function, status), hint);
}

std::string FmuInstance::hint_for(const char* function, Status status) const {
  if (status == Status::Fatal) {
    return "the unit may have damaged this process; save what you need and end it";
  }
  if (was_restored_) return state_hint(name_);
  if (std::string_view(function).ends_with("DoStep")) return step_hint();
  return state_hint(function, name_);
}

// ---- States ----

void FmuInstance::give_up_saving(std::string failure) {
  save_failure_ = std::move(failure);
  warn(fmt::format("{}; its state is not saved any more, so it cannot be rolled back; {}",
                   save_failure_, state_hint(name_)));
}

void FmuInstance::warn_of_null_state(const char* saved_by) {
  if (std::exchange(has_null_state_warning_, true)) return;
  warn(
      fmt::format("{} returned {} and no state (NULL), which is restored now; if the unit keeps "
                  "none of its own, it goes on as if nothing were undone, and its results are "
                  "wrong: compare it by stride verify --check restore; {}",
                  saved_by, status_name(Status::Ok), state_hint(name_)));
}

void FmuInstance::fail_for_state(const char* function, Status status) {
  const std::string failure = failure_of(function, status);
  fail(failure, state_hint(name_));
}

void FmuInstance::fail_null_state(const char* function) const {
  fail(fmt::format("{} has nothing to work on: the unit gave no state (NULL) where it was saved",
                   function),
       state_hint(name_));
}

void FmuInstance::fail_without_state() const {
  if (save_failure_.empty()) fail("no state of it has been saved");
  fail(fmt::format("its state could not be saved: {}", save_failure_), state_hint(name_));
}

void FmuInstance::fail_thrown(const char* function) {
  std::string what = "something that is not a std::exception";
  try {
    throw;
  } catch (const std::exception& exception) {
    what = exception.what();
  } catch (...) {  // it has no text
  }
  if (is_copy_of_process()) leave_fork(function);
  failed_in_ = function;
  check_mode(function);
  present_.end();
  mark_unusable();
  log_held();
  fail(fmt::format("{} threw {}", function, what), "a function of FMI returns a status instead");
}

// ---- Forks ----

/// In the new process, which has this thread only. stride itself makes none within a call. A
/// process that is made without fork() is seen by its ForkMark alone, which a function that the
/// unit calls back may set anew.
void FmuInstance::note_fork() noexcept {
  core::Listed<FmuInstance>::for_each([](FmuInstance& instance) {
    instance.present_.is_by_this_thread() ? instance.add(kFork) : instance.remove(kFork);
  });
}

/// What is in memory, as lines of results, is the first process's to write.
void FmuInstance::leave_fork(const char* function) const {
  const std::string text = core::terminal_text(fmt::format(
      "stride: warning: unit '{}': {} called fork() and returned in both processes; the new "
      "one ends here\n",
      name_, function));
  (void)!::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(0);
}

// ---- What calls change of the process ----

void FmuInstance::restore_mode(const char* function) {
  const core::ProcessorMode left = core::ProcessorMode::present();
  mode_.set();
  warn_of_mode(function, left);
}

void FmuInstance::warn_of_mode(const char* function, const core::ProcessorMode& left) {
  if (std::exchange(has_mode_warning_, true)) return;
  warn(
      fmt::format("{} left another mode of the processor behind ({}); it is put back, here and "
                  "after later calls, since all units depend on it: a function has to restore it "
                  "before it returns",
                  function, mode_.differences(left)));
}

void FmuInstance::check_registers(const char* function) {
  if (core::ProcessorMode::are_registers_empty()) return;
  if (std::exchange(has_register_warning_, true)) return;
  warn(
      fmt::format("{} left registers of x87 or MMX in use; they are emptied, here and after later "
                  "calls, since long double values of other units would become NaN: a function has "
                  "to empty them before it returns (_mm_empty, fstp)",
                  function));
}

void FmuInstance::restore_process(const char* function) {
  if (watched_calls_ > 0) --watched_calls_;
  if (options_.process == nullptr) return;
  const std::vector<std::string> changes = options_.process->restore();
  if (changes.empty()) return;
  if (!library_->python().empty() && std::ranges::all_of(changes, is_of_interpreter)) {
    if (!options_.log) return;
    options_.log(name_, Status::Ok, "stride",
                 fmt::format("in {} '{}' changed {}; it is put back", function, library_->python(),
                             fmt::join(changes, ", ")));
    return;
  }
  const bool has_moved = std::ranges::find(changes, "the working folder") != changes.end();
  warn(
      fmt::format("{} changed {}, which all code in the process shares: a function has to leave "
                  "that as it was{}",
                  function, fmt::join(changes, ", "),
                  has_moved ? fmt::format("; a unit that looks for its files there needs a process "
                                          "of its own (--isolate={})",
                                          name_)
                            : ""));
}

std::string FmuInstance::failure_of(const char* function, Status status) {
  return fmt::format("{} returned {}: {}", function, status_name(status), take_messages(function));
}

std::string FmuInstance::status_name(Status status) const {
  constexpr const char* kNames[] = {"OK", "Warning", "Discard", "Error", "Fatal", "Pending"};
  if (is_known(status)) return std::string(prefix_) + kNames[static_cast<std::size_t>(status)];
  return fmt::format("{}, a status that FMI {}.0 does not have", static_cast<int>(status),
                     major_version());
}

bool FmuInstance::is_known(Status status) const {
  const Status last = may_be_pending() ? Status::Pending : Status::Fatal;
  return Status::Ok <= status && status <= last;
}

void FmuInstance::fail(const std::string& message, const std::string& hint) const {
  core::fail_run({.where = options_.where, .unit = name_, .time = time()}, message, hint);
}

void FmuInstance::fail_missing(const char* name, const char* capability) const {
  const std::string hint = state_hint(name, name_);
  fail(
      fmt::format("its library does not export {}", name),
      fmt::format("a unit with {} must export it{}{}", capability, hint.empty() ? "" : "; ", hint));
}

bool is_any_call_unfinished() noexcept {
  bool is_any = false;
  core::Listed<FmuInstance>::for_each(
      [&](const FmuInstance& instance) { is_any |= instance.is_in_call(); });
  return is_any;
}

std::vector<UnitCall> unfinished_calls(const char* thread) {
  std::vector<UnitCall> calls;
  core::Listed<FmuInstance>::for_each([&](const FmuInstance& instance) {
    const PresentCall& present = instance.present_;
    if (present.function() == nullptr) return;
    const core::ValueReference* const variable = present.variable();
    calls.push_back({.function = present.function(),
                     .unit = instance.name_,
                     .where = instance.options_.where,
                     .time = instance.time(),
                     .variable = variable != nullptr ? instance.variable_name(*variable) : "",
                     .is_by_thread = present.thread() == thread});
  });
  return calls;
}

std::optional<UnitCall> last_call_of_this_thread() {
  std::optional<UnitCall> last;
  core::Listed<FmuInstance>::for_each([&](const FmuInstance& instance) {
    const char* const function = instance.present_.last_function_of_thread();
    if (function == nullptr) return;
    last = {.function = function,
            .unit = instance.name_,
            .where = instance.options_.where,
            .time = instance.time(),
            .variable = {},
            .is_by_thread = true};
  });
  return last;
}

// ---- Messages ----

void FmuInstance::receive(Status status, const char* category, const char* message) noexcept {
  try {
    std::string text = message != nullptr ? message : "";
    if (!is_known(status)) {
      text += fmt::format(" (logged with {})", status_name(status));
      status = Status::Error;
    }
    if (status == Status::Discard || status == Status::Error || status == Status::Fatal) {
      const std::lock_guard lock(messages_mutex_);
      add(kMessages);
      if (messages_.size() < kMaxMessages) {
        messages_.push_back(text);
        if (is_reason_of_call(status, text)) {
          held_.push_back({category != nullptr ? category : "", text});
          return;
        }
      }
    }
    if (is_repeating_ || !options_.log) return;
    options_.log(name_, status, category != nullptr ? category : "", text);
  } catch (...) {  // nothing may cross the unit's C code
  }
}

/// "fmi3DoStep: the fuse has blown" is what the unit kit, and others, log right before they return:
/// the error of the call contains it, and logged it would be there twice.
bool FmuInstance::is_reason_of_call(Status status, std::string_view message) const {
  const char* const function = present_.function();
  if (status != Status::Error || function == nullptr) return false;
  const std::size_t size = std::string_view(function).size();
  return message.starts_with(function) && message.substr(size).starts_with(": ");
}

void FmuInstance::log_held() {
  std::vector<HeldMessage> held;
  {
    const std::lock_guard lock(messages_mutex_);
    held = std::exchange(held_, {});
  }
  if (is_repeating_ || !options_.log) return;
  for (const HeldMessage& message : held) {
    options_.log(name_, Status::Error, message.category, message.text);
  }
}

void FmuInstance::drop_messages() {
  log_held();
  const std::lock_guard lock(messages_mutex_);
  remove(kMessages);
  messages_.clear();
}

std::string FmuInstance::take_messages(const std::string& function) {
  const std::lock_guard lock(messages_mutex_);
  remove(kMessages);
  held_.clear();
  std::vector<std::string> messages = std::exchange(messages_, {});
  if (messages.empty()) return "the unit gives no reason; it may have printed one itself";
  const std::string prefix = function + ": ";
  for (std::string& message : messages) {
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
  }
  return fmt::format("{}", fmt::join(messages, "; "));
}

void FmuInstance::take_rejection_reason(const char* function) {
  log_held();
  rejection_reason_ = has_messages() ? take_messages(function) : "";
}

void FmuInstance::warn(const std::string& message) const {
  if (options_.log) options_.log(name_, Status::Warning, "stride", message);
}

// ---- Times ----

std::optional<Time> FmuInstance::time() const {
  if (present_.is_in_row()) return row_->present().time();
  return row_ != nullptr && row_->steps() != 0 ? row_->to() : time_;
}

double FmuInstance::set_stop(Time start, std::optional<Time> stop) {
  start_ = start;
  stop_ = stop;
  stop_seconds_ = std::numeric_limits<double>::infinity();
  if (!stop) return 0;
  stop_seconds_ = to_seconds(*stop);
  if (options_.step && *stop > start) {
    const core::Grid grid(start, *options_.step);
    const Time last = grid.last_point(*stop - Duration(1));
    if (grid.is_regular(*stop - last)) {
      stop_seconds_ = std::max(stop_seconds_, grid.seconds(last) + grid.seconds(*stop - last));
    }
  }
  return stop_seconds_;
}

std::string FmuInstance::short_step_hint() const {
  const Duration size = present_step_.to - present_step_.from;
  if (!options_.step || present_step_.to != stop_) return "";
  if (!core::Grid(start_.value_or(Time{}), *options_.step).is_shorter(size)) return "";
  return fmt::format(
      "this step is one of {} s, since the run ends there, and the others are of {} s: if the unit "
      "makes whole steps only, stop at a multiple of its step (--stop {})",
      core::to_text(size), core::to_text(*options_.step), core::to_text(present_step_.from));
}

std::string FmuInstance::step_hint() const {
  const std::string shorter = short_step_hint();
  if (!shorter.empty()) return shorter;
  const core::UnitDescription& unit = *parts_.description;
  const bool may_be_the_reason = !unit.can_vary_step || present_step_.from == start_;
  const Duration size = present_step_.to - present_step_.from;
  return may_be_the_reason ? core::own_step_hint(name_, unit, size) : "";
}

Time FmuInstance::checked_time(double seconds, const char* what) const {
  try {
    return time_from_seconds(seconds);
  } catch (const std::out_of_range& error) {
    fail(fmt::format("{} is {}: {}", what, seconds, error.what()));
  }
}

bool FmuInstance::is_within(const core::StepInterval& interval, double seconds) {
  const double tolerance = time_tolerance(interval);
  return seconds >= interval.begin_seconds - tolerance &&
         seconds <= interval.end_seconds + tolerance;
}

std::optional<Time> FmuInstance::instant_within(const core::StepInterval& interval,
                                                std::optional<double> seconds,
                                                const char* what) const {
  if (!seconds || !is_within(interval, *seconds)) return std::nullopt;
  if (is_end(interval, *seconds)) return interval.to;
  return std::clamp(checked_time(*seconds, what), interval.from, interval.to);
}

std::string FmuInstance::how_far(const core::StepInterval& interval, std::optional<double> seconds,
                                 const char* what) {
  if (!seconds) return fmt::format("does not report how far it came ({})", what);
  if (is_within(interval, *seconds)) {
    return fmt::format("reports that it came no further than where the step began ({})", what);
  }
  return fmt::format("reports that it came to {} s, which is not in the step ({})", *seconds, what);
}

void FmuInstance::fail_discarded(const core::StepInterval& interval, const char* returned,
                                 const std::string& how_far, const char* why,
                                 const char* hint) const {
  const std::string other_step = step_hint();
  fail(fmt::format("{} in the step to {} s, the unit {}, and {}{}{}", returned,
                   core::to_text(interval.to), how_far, why,
                   rejection_reason_.empty() ? "" : "; message of the unit: ", rejection_reason_),
       other_step.empty() ? hint : other_step);
}

}  // namespace stride::importer
