#include "master/loader/wire/unit_proxy.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "master/loader/wire/arguments.h"

namespace stride::isolation {
namespace {

using Clock = std::chrono::steady_clock;

/// The end comes from the unit's process, where anything may be written.
std::chrono::nanoseconds time_since(Clock::time_point began, Clock::time_point end) {
  return std::clamp(end, began, std::max(began, Clock::now())) - began;
}

}  // namespace

// ---- Requests ----

template <auto function, class... Arguments>
auto UnitProxy::call(Arguments&... arguments) {
  using Traits = FunctionTraits<decltype(function)>;
  using Result = typename Traits::Result;
  constexpr bool kMayBeDeferred = std::get<row_of<function>()>(kCalls).wait == Wait::Deferred;
  constexpr RequestCode kRequest = code_of<function>();
  times_.note_begin<function>(arguments...);
  const auto make = [&]<class... P>(std::type_identity<std::tuple<P...>>) -> Result {
    static_assert(!kMayBeDeferred || (std::is_void_v<Result> && !(Argument<P>::kIsFilled || ...)),
                  "what has a result is awaited");
    const auto put = [&](PacketWriter& to) { (Argument<P>::put(to, arguments), ...); };
    if constexpr (kMayBeDeferred) {
      if (send_or_defer(kRequest, put)) return;
    } else {
      send(kRequest, put);
    }
    return receive([&](PacketReader& from) -> Result {
      (Argument<P>::take_back(from, arguments), ...);
      if constexpr (!std::is_void_v<Result>) return Form<Result>::take(from);
    });
  };
  constexpr std::type_identity<typename Traits::Parameters> kParameters;
  if constexpr (std::is_void_v<Result>) {
    make(kParameters);
    times_.note_end<function>(arguments...);
  } else {
    return make(kParameters);
  }
}

/// Serves what the unit asks for until it has replied.
Reply UnitProxy::await_done() {
  Reply reply = await(std::nullopt);
  while (reply.code == ReplyCode::RequestInputs) {
    const bool are_set = update_inputs(reply.packet.take<double>());
    if (has_failed()) throw_failure(reply);
    post(are_set ? RequestCode::InputsUpdated : RequestCode::InputsNotUpdated, write());
    reply = await(std::nullopt);
  }
  if (reply.code != ReplyCode::Done) throw_failure(reply);
  return reply;
}

bool UnitProxy::update_inputs(double seconds_into_step) {
  try {
    if (input_update_) input_update_(seconds_into_step);
    return true;
  } catch (...) {
    input_failure_ = std::current_exception();
    return false;
  }
}

void UnitProxy::throw_failure(Reply& reply) {
  if (reply.code != ReplyCode::Failed) {
    if (input_failure_) std::rethrow_exception(std::exchange(input_failure_, nullptr));
    throw BadPacket("an answer that nobody has asked for");
  }
  SentError error = take_error(reply.packet);
  reply.packet.require_end();
  supplement(error);
  error.raise();
}

// ---- Life cycle ----

void UnitProxy::set_capabilities(const CapabilitySet& capabilities) {
  capabilities_ = capabilities;
  for (const core::CapabilityId id :
       {core::CapabilityId::UnitDiagnostics, core::CapabilityId::HostDiagnostics,
        core::CapabilityId::ConcurrentSteps}) {
    capabilities_.set(static_cast<std::size_t>(id));
  }
}

core::Capability* UnitProxy::find_capability(core::CapabilityId id) {
  if (!capabilities_.test(static_cast<std::size_t>(id))) return nullptr;
  return implemented(id);
}

void UnitProxy::terminate() {
  drop_step();
  if (!has_failed()) call<&core::Unit::terminate>();
}

void UnitProxy::free() {
  drop_step();
  if (std::exchange(is_freed_, true) || has_failed()) return;
  call<&core::Unit::free>();
}

core::HostStatistics UnitProxy::fetch_statistics() {
  return call<&core::HostDiagnostics::host_statistics>();
}

void UnitProxy::reset() {
  call<&core::Resetting::reset>();
  rejection_reason_.clear();
}

void UnitProxy::set_repeating(bool repeating) {
  if (!has_failed()) call<&core::UnitDiagnostics::set_repeating>(repeating);
}

// ---- Modes ----

void UnitProxy::enter_configuration_mode() {
  call<&core::ConfigurationMode::enter_configuration_mode>();
}

void UnitProxy::exit_configuration_mode() {
  call<&core::ConfigurationMode::exit_configuration_mode>();
}

void UnitProxy::enter_initialization(Time start, std::optional<Time> stop) {
  call<&core::Unit::enter_initialization>(start, stop);
}

void UnitProxy::exit_initialization() { call<&core::Unit::exit_initialization>(); }

void UnitProxy::enter_event_mode() { call<&core::Unit::enter_event_mode>(); }

core::EventResult UnitProxy::update_discrete_states() {
  return call<&core::Unit::update_discrete_states>();
}

void UnitProxy::enter_step_mode() { call<&core::Unit::enter_step_mode>(); }

// ---- Values ----

void UnitProxy::get(References references, core::ValueBlock& values) {
  call<&core::Unit::get>(references, values);
}

void UnitProxy::set(References references, const core::ValueBlock& values) {
  call<&core::Unit::set>(references, values);
}

void UnitProxy::get_directional_derivative(References unknowns, References knowns,
                                           std::span<const double> seed,
                                           std::span<double> sensitivity) {
  call<&core::DirectionalDerivatives::get_directional_derivative>(unknowns, knowns, seed,
                                                                  sensitivity);
}

std::string UnitProxy::describe_message(core::ValueReference variable, const core::Binary& value) {
  return call<&core::MessageText::describe_message>(variable, value);
}

// ---- States ----

void UnitProxy::save_state() { call<&core::StateSaving::save_state>(); }

void UnitProxy::restore_state() { call<&core::StateSaving::restore_state>(); }

void UnitProxy::select_state(std::size_t slot) { call<&core::StateSaving::select_state>(slot); }

std::vector<std::uint8_t> UnitProxy::serialize_state() {
  return call<&core::StateSerialization::serialize_state>();
}

void UnitProxy::deserialize_state(std::span<const std::uint8_t> bytes) {
  call<&core::StateSerialization::deserialize_state>(bytes);
}

// ---- Clocks, and idle time ----

core::ClockInterval UnitProxy::clock_interval(const core::Variable& clock) {
  return call<&core::ClockIntervals::clock_interval>(clock);
}

core::Interval UnitProxy::clock_shift(const core::Variable& clock) {
  return call<&core::ClockIntervals::clock_shift>(clock);
}

void UnitProxy::enable_idle_skipping(Duration max_skip) {
  call<&core::IdlePromises::enable_idle_skipping>(max_skip);
}

void UnitProxy::set_idle_tolerances(References outputs, std::span<const double> tolerances) {
  call<&core::IdlePromises::set_idle_tolerances>(outputs, tolerances);
}

Time UnitProxy::idle_until() { return call<&core::IdlePromises::idle_until>(); }

void UnitProxy::get_derivatives(References outputs, std::span<double> derivatives) {
  call<&core::IdlePromises::get_derivatives>(outputs, derivatives);
}

// ---- Steps ----

core::StepResult UnitProxy::step(const core::StepInterval& interval) {
  return step(interval, core::StepValues{});
}

core::StepResult UnitProxy::step(const core::StepInterval& interval,
                                 const core::StepValues& values) {
  UnitProxy::begin_step(interval, values, {});
  return finish_step();
}

core::StepResult UnitProxy::save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                           const core::StepValues& values) {
  if (&unit != this) return StateSaving::save_with_step(unit, interval, values);
  UnitProxy::begin_step(interval, values, {.saves_state = true});
  return finish_step();
}

void UnitProxy::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                           const Extras& extras) {
  const std::uint32_t plan = plan_number(values);
  times_.now = interval.from;
  send(RequestCode::Step, [&](PacketWriter& to) {
    to.put(StepRequest(plan, interval, extras.saves_state, extras.is_timed));
    for (const core::BoundValues& input : values.inputs) put_values(to, *input.block);
  });
  if (extras.saves_state) times_.note_saved(interval.from);
  step_ = PresentStep{interval, values};
  if (extras.is_timed) step_->began = Clock::now();
}

core::StepResult UnitProxy::finish_step() {
  const PresentStep step = *std::exchange(step_, std::nullopt);
  const core::StepResult result =
      receive([&](PacketReader& from) { return take_result(from, step); });
  if (!result.rejected) times_.now = result.reached;
  return result;
}

core::StepResult UnitProxy::take_result(PacketReader& from, const PresentStep& step) {
  const core::StepResult result = take_step(from, step.interval);
  if (step.began) step_time_ = time_since(*step.began, from.take<Clock::time_point>());
  if (result.rejected) {
    rejection_reason_ = from.take_text();
  } else {
    for (const core::BoundValues& output : step.values.outputs) take_values(from, *output.block);
  }
  return result;
}

/// A step that does not end is no reason to wait for ever.
void UnitProxy::drop_step() noexcept {
  if (!std::exchange(step_, std::nullopt)) return;
  try {
    guard([&] {
      while (await(patience_).code == ReplyCode::RequestInputs) {
        post(RequestCode::InputsNotUpdated, write());
      }
    });
  } catch (const std::exception& failure) {
    warn(fmt::format("its step was dropped, since another unit had failed: {}", failure.what()));
  }
}

std::uint32_t UnitProxy::plan_number(const core::StepValues& values) {
  if (const auto known = plans_.find(values)) return *known;
  const std::uint32_t number = plans_.add(values);
  const auto put = [&](PacketWriter& to) {
    to.put(number);
    put_shape(to, values);
  };
  if (!send_or_defer(RequestCode::MakePlan, put)) receive([](PacketReader&) {});
  return number;
}

void UnitProxy::set_input_update(core::InputUpdate update) {
  input_update_ = std::move(update);
  call<&core::InputsWithinStep::set_input_update>(input_update_);
}

}  // namespace stride::isolation
