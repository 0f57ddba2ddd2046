#include "master/fmi/fmi3_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::fmi {
namespace {

constexpr std::size_t kMaxMessages = 8;

const char* status_name(fmi3Status status) {
  constexpr const char* kNames[] = {"fmi3OK", "fmi3Warning", "fmi3Discard", "fmi3Error",
                                    "fmi3Fatal"};
  const auto i = static_cast<std::size_t>(status);
  return i < std::size(kNames) ? kNames[i] : "a status that FMI 3.0 does not have";
}

/// The getter and setter of a C type. Enumerations travel as Int64.
template <class T>
struct Access;
#define STRIDE_ACCESS(T)                                  \
  template <>                                             \
  struct Access<fmi3##T> {                                \
    static constexpr const char* kGetName = "fmi3Get" #T; \
    static constexpr const char* kSetName = "fmi3Set" #T; \
    static constexpr auto kGet = &Functions::Get##T;      \
    static constexpr auto kSet = &Functions::Set##T;      \
  };
FMI3_VALUE_TYPES(STRIDE_ACCESS)
#undef STRIDE_ACCESS

/// How far the unit's idea of where a step ended may be from ours: the rounding of doubles, and
/// what a unit that adds up its own internal steps may have drifted.
double time_tolerance(double point, double end) {
  constexpr double kPicosecond = 1e-12;
  constexpr double kShareOfStep = 1e-6;
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(end);
  return kPicosecond + rounding + kShareOfStep * (end - point);
}

/// The inputs that may be set within a step.
std::vector<core::ValueReference> intermediate_inputs(const core::UnitDescription& description) {
  std::vector<core::ValueReference> references;
  if (!description.provides_intermediate_update) return references;
  for (const core::Variable& variable : description.variables) {
    const bool is_input = variable.causality == core::Causality::Input &&
                          variable.variability == core::Variability::Continuous;
    if (is_input && variable.intermediate_update) references.push_back(variable.reference);
  }
  return references;
}

}  // namespace

// ---- Life and death ----

Fmi3Unit::Fmi3Unit(std::string name, UnitParts parts, InstanceOptions options)
    : fmi_(parts.library->functions()),
      is_condemned_(parts.library->is_condemned()),
      name_(std::move(name)),
      parts_(std::move(parts)),
      options_(std::move(options)),
      tangent_outputs_(tangent_outputs(*parts_.description)) {
  check_callable("fmi3InstantiateCoSimulation");
  const core::UnitDescription& description = *parts_.description;
  const bool has_resources = !parts_.resource_path.empty();
  std::vector<core::ValueReference> intermediate;
  if (options_.intermediate_update) intermediate = intermediate_inputs(description);
  ++calls_;
  instance_ = fmi_.InstantiateCoSimulation(
      name_.c_str(), description.instantiation_token.c_str(),
      has_resources ? parts_.resource_path.c_str() : nullptr, fmi3False, options_.debug_logging,
      description.has_event_mode, options_.early_return_allowed, intermediate.data(),
      intermediate.size(), this, &on_log, intermediate.empty() ? nullptr : &on_intermediate_update);
  if (instance_ == nullptr) {
    fail(fmt::format("fmi3InstantiateCoSimulation failed: {}",
                     take_messages("fmi3InstantiateCoSimulation")));
  }
}

Fmi3Unit::~Fmi3Unit() {
  if (instance_ == nullptr || is_condemned_) return;
  free_state(state_);
  for (KeptState& kept : kept_states_) free_state(kept.state);
  if (!is_condemned_) fmi_.FreeInstance(instance_);
}

void Fmi3Unit::enter_initialization(Time start, std::optional<Time> stop) {
  time_ = start;
  call("fmi3EnterInitializationMode", fmi_.EnterInitializationMode, fmi3False, 0.0,
       to_seconds(start), stop.has_value(), to_seconds(stop.value_or(Time{})));
}

void Fmi3Unit::exit_initialization() {
  call("fmi3ExitInitializationMode", fmi_.ExitInitializationMode);
}

void Fmi3Unit::terminate() {
  if (failed_in_ != nullptr || is_condemned_) return;
  call("fmi3Terminate", fmi_.Terminate);
}

// ---- Calls, messages and failures ----

void Fmi3Unit::fail_not_callable(const char* name) const {
  if (failed_in_ != nullptr) {
    fail(fmt::format("{} cannot be called, because {} has failed before", name, failed_in_));
  }
  throw core::ConsequentError(
      core::Error::Kind::Run, {.where = options_.where, .unit = name_, .time = time_},
      fmt::format("{} cannot be called, because an instance of the same FMU has returned "
                  "fmi3Fatal before",
                  name));
}

inline void Fmi3Unit::rethrow_update_failure() {
  if (update_failure_) [[unlikely]]
    std::rethrow_exception(std::exchange(update_failure_, nullptr));
}

/// What a status other than fmi3OK, or a message of a failure, means for the call that has just
/// ended.
fmi3Status Fmi3Unit::look_into(const char* name, fmi3Status status) {
  if (status == fmi3Discard) return status;
  if (status != fmi3OK && status != fmi3Warning) fail_call(name, status);
  if (has_messages_.load(std::memory_order_relaxed)) take_messages(name);
  return status;
}

void Fmi3Unit::fail_call(const char* function, fmi3Status status) {
  failed_in_ = function;
  const bool is_fatal = status != fmi3Error && status != fmi3Discard;
  if (is_fatal) parts_.library->condemn();
  rethrow_update_failure();  // it is the cause of what the unit answered
  fail(fmt::format("{} returned {}: {}", function, status_name(status), take_messages(function)),
       is_fatal ? "the unit may have damaged this process; save what you need and end it" : "");
}

void Fmi3Unit::fail(const std::string& message, const std::string& hint) const {
  core::fail_run({.where = options_.where, .unit = name_, .time = time_}, message, hint);
}

void Fmi3Unit::on_log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                      fmi3String message) {
  try {
    static_cast<Fmi3Unit*>(environment)
        ->receive(status, category != nullptr ? category : "", message != nullptr ? message : "");
  } catch (...) {  // nothing may cross the unit's C code
  }
}

void Fmi3Unit::receive(fmi3Status status, const std::string& category, const std::string& message) {
  if (status != fmi3OK && status != fmi3Warning) {
    const std::lock_guard lock(messages_mutex_);
    if (messages_.size() < kMaxMessages) messages_.push_back(message);
    has_messages_ = true;
  }
  if (options_.log) options_.log(name_, status, category, message);
}

/// The failure messages of the call that has just ended, for one line of text.
std::string Fmi3Unit::take_messages(const std::string& function) {
  const std::lock_guard lock(messages_mutex_);
  has_messages_ = false;
  std::vector<std::string> messages = std::exchange(messages_, {});
  if (messages.empty()) return "the unit gives no reason";
  const std::string prefix = function + ": ";
  for (std::string& message : messages) {
    if (message.starts_with(prefix)) message.erase(0, prefix.size());
  }
  return fmt::format("{}", fmt::join(messages, "; "));
}

// ---- Values ----

// Most values are of this type.
inline void Fmi3Unit::get(const core::BoundValues& values) {
  if (values.float64s.empty()) return get(values.references, *values.block);
  call("fmi3GetFloat64", fmi_.GetFloat64, values.references.data(), values.references.size(),
       values.float64s.data(), values.float64s.size());
}

inline void Fmi3Unit::set(const core::BoundValues& values) {
  if (values.float64s.empty()) return set(values.references, *values.block);
  call("fmi3SetFloat64", fmi_.SetFloat64, values.references.data(), values.references.size(),
       values.float64s.data(), values.float64s.size());
}

void Fmi3Unit::get(References references, core::ValueBlock& values) {
  if (values.type() == core::ValueType::Clock) {
    call("fmi3GetClock", fmi_.GetClock, references.data(), references.size(),
         values.numbers<bool>().data());
    return;
  }
  core::visit(values, [&]<class T>(std::span<T> elements) {
    if constexpr (std::is_same_v<T, std::string>) {
      get_strings(references, elements);
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      get_binaries(references, elements);
    } else {
      call(Access<T>::kGetName, fmi_.*Access<T>::kGet, references.data(), references.size(),
           elements.data(), elements.size());
    }
  });
}

void Fmi3Unit::set(References references, const core::ValueBlock& values) {
  if (values.type() == core::ValueType::Clock) {
    call("fmi3SetClock", fmi_.SetClock, references.data(), references.size(),
         values.numbers<bool>().data());
    return;
  }
  core::visit(values, [&]<class T>(std::span<const T> elements) {
    if constexpr (std::is_same_v<T, std::string>) {
      set_strings(references, elements);
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      set_binaries(references, elements);
    } else {
      call(Access<T>::kSetName, fmi_.*Access<T>::kSet, references.data(), references.size(),
           elements.data(), elements.size());
    }
  });
}

// What a unit returns is its own memory, valid until its next function is called: copied at once.

void Fmi3Unit::get_strings(References references, std::span<std::string> values) {
  texts_.assign(values.size(), nullptr);
  call("fmi3GetString", fmi_.GetString, references.data(), references.size(), texts_.data(),
       texts_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i].assign(texts_[i] != nullptr ? texts_[i] : "");
  }
}

void Fmi3Unit::set_strings(References references, std::span<const std::string> values) {
  texts_.resize(values.size());
  std::transform(values.begin(), values.end(), texts_.begin(),
                 [](const std::string& value) { return value.c_str(); });
  call("fmi3SetString", fmi_.SetString, references.data(), references.size(),
       std::as_const(texts_).data(), texts_.size());
}

void Fmi3Unit::get_binaries(References references, std::span<core::Binary> values) {
  bytes_.assign(values.size(), nullptr);
  sizes_.assign(values.size(), 0);
  call("fmi3GetBinary", fmi_.GetBinary, references.data(), references.size(), sizes_.data(),
       bytes_.data(), bytes_.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (sizes_[i] != 0 && bytes_[i] == nullptr) {
      fail(fmt::format("fmi3GetBinary gave {} bytes at the address NULL", sizes_[i]));
    }
    values[i].assign(bytes_[i], bytes_[i] + sizes_[i]);
  }
}

void Fmi3Unit::set_binaries(References references, std::span<const core::Binary> values) {
  bytes_.resize(values.size());
  sizes_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    bytes_[i] = values[i].data();
    sizes_[i] = values[i].size();
  }
  call("fmi3SetBinary", fmi_.SetBinary, references.data(), references.size(),
       std::as_const(sizes_).data(), std::as_const(bytes_).data(), bytes_.size());
}

// ---- Steps and events ----

core::StepResult Fmi3Unit::step(const core::StepInterval& interval) {
  return step(interval, core::StepValues{});
}

core::StepResult Fmi3Unit::step(const core::StepInterval& interval,
                                const core::StepValues& values) {
  for (const core::BoundValues& input : values.inputs) set(input);
  time_ = interval.from;
  // no other double lands nearer to the end
  const double size = interval.end_seconds - interval.begin_seconds;
  if (!(size > 0)) {  // to the unit, whose time is a double, it is the same instant
    time_ = interval.to;
    return {.reached = interval.to};
  }
  bool event_needed = false;
  bool terminate = false;
  bool early = false;
  double last_successful = interval.end_seconds;
  step_point_ = interval.begin_seconds;
  const fmi3Boolean never_goes_back = !options_.may_go_back;  // noSetFMUStatePriorToCurrentPoint
  const fmi3Status status =
      call_discardable("fmi3DoStep", fmi_.DoStep, interval.begin_seconds, size, never_goes_back,
                       &event_needed, &terminate, &early, &last_successful);
  rethrow_update_failure();
  if (status == fmi3Discard) {
    rejection_reason_ = has_messages_ ? take_messages("fmi3DoStep") : "";
    return {.rejected = true, .reached = interval.from};
  }
  if (event_needed && !parts_.description->has_event_mode) [[unlikely]]
    fail("fmi3DoStep returned eventHandlingNeeded, and the unit has no Event Mode (hasEventMode)");
  if (!early && last_successful != interval.end_seconds) compare_times(interval, last_successful);
  time_ = early ? reached_early(interval, last_successful) : interval.to;
  for (const core::BoundValues& output : values.outputs) get(output);
  return {.early_return = early,
          .event_needed = event_needed,
          .terminate = terminate,
          .reached = *time_};
}

// ---- Inputs within a step ----

void Fmi3Unit::on_intermediate_update(fmi3InstanceEnvironment environment, fmi3Float64 time,
                                      fmi3Boolean set_requested, fmi3Boolean, fmi3Boolean,
                                      fmi3Boolean, fmi3Boolean* early_return_requested,
                                      fmi3Float64*) {
  if (early_return_requested != nullptr) *early_return_requested = fmi3False;
  if (set_requested) static_cast<Fmi3Unit*>(environment)->update_inputs(time);
}

/// Nothing may cross the unit's C code: step() throws what goes wrong here.
void Fmi3Unit::update_inputs(double time) noexcept {
  if (!input_update_ || update_failure_) return;
  try {
    input_update_(time - step_point_);
  } catch (...) {
    update_failure_ = std::current_exception();
  }
}

/// FMI 3.0, 4.2: a unit with a fixed internal step may stand elsewhere than where it was sent.
void Fmi3Unit::compare_times(const core::StepInterval& interval, double last_successful) {
  const double tolerance = time_tolerance(interval.begin_seconds, interval.end_seconds);
  if (std::abs(last_successful - interval.end_seconds) <= tolerance) return;
  checked_time(last_successful, "lastSuccessfulTime");
  if (std::exchange(has_time_warning_, true) || !options_.log) return;
  const auto& internal_step = parts_.description->fixed_internal_step;
  options_.log(
      name_, fmi3Warning, "stride",
      fmt::format("the step to {} s ended at the unit's own time {} s (lastSuccessfulTime) without "
                  "an early return{}; its outputs are taken as those at {} s, here and in later "
                  "steps",
                  core::to_text(interval.to), last_successful,
                  internal_step ? fmt::format(", since its fixedInternalStepSize is {} s",
                                              core::to_text(Time(*internal_step)))
                                : "",
                  core::to_text(interval.to)));
}

Time Fmi3Unit::reached_early(const core::StepInterval& interval, double last_successful) const {
  const double point = interval.begin_seconds;
  const double end = interval.end_seconds;
  const double tolerance = time_tolerance(point, end);
  if (last_successful == end) return interval.to;  // which a double cannot always tell
  if (!options_.early_return_allowed) {
    fail("fmi3DoStep returned early, which was not allowed at its instantiation");
  }
  if (!(last_successful >= point - tolerance && last_successful <= end + tolerance)) {
    fail(fmt::format("fmi3DoStep returned early at {} s, which is outside of the step to {} s",
                     last_successful, core::to_text(interval.to)));
  }
  return std::clamp(checked_time(last_successful, "lastSuccessfulTime"), interval.from,
                    interval.to);
}

Time Fmi3Unit::checked_time(double seconds, const char* what) const {
  try {
    return time_from_seconds(seconds);
  } catch (const std::out_of_range& error) {
    fail(fmt::format("{} is {}: {}", what, seconds, error.what()));
  }
}

void Fmi3Unit::save_state() {
  if (fmi_.GetFMUState == nullptr) {
    fail("its library does not export fmi3GetFMUState",
         "a unit that is to be rolled back must have it (canGetAndSetFMUState)");
  }
  call("fmi3GetFMUState", fmi_.GetFMUState, &state_);  // the unit uses the state's memory again
  state_time_ = time_;
}

void Fmi3Unit::restore_state() {
  if (state_ == nullptr) fail("no state of it has been saved that could be restored");
  if (fmi_.SetFMUState == nullptr) {
    fail("its library does not export fmi3SetFMUState",
         "a unit that is to be rolled back must have it (canGetAndSetFMUState)");
  }
  call("fmi3SetFMUState", fmi_.SetFMUState, state_);
  time_ = state_time_;
}

void Fmi3Unit::enter_event_mode() { call("fmi3EnterEventMode", fmi_.EnterEventMode); }

void Fmi3Unit::enter_step_mode() { call("fmi3EnterStepMode", fmi_.EnterStepMode); }

core::EventResult Fmi3Unit::update_discrete_states() {
  bool iterate = false;
  bool terminate = false;
  bool nominals_changed = false;
  bool values_changed = false;
  bool has_next = false;
  double next = 0;
  call("fmi3UpdateDiscreteStates", fmi_.UpdateDiscreteStates, &iterate, &terminate,
       &nominals_changed, &values_changed, &has_next, &next);
  core::EventResult result{.iterate = iterate, .terminate = terminate, .next_event = {}};
  // Some units say "never" by a time that no simulation reaches.
  if (has_next && !(next > kMaxSeconds)) {
    result.next_event = checked_time(next, "nextEventTime");
    // a unit may compare: it is not entered a rounding error before the instant that it said
    while (to_seconds(*result.next_event) < next) *result.next_event += Duration(1);
  }
  return result;
}

}  // namespace stride::fmi
