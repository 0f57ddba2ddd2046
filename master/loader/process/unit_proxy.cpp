#include "master/loader/process/unit_proxy.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace stride::isolation {
namespace {

using Clock = std::chrono::steady_clock;

/// The end comes from the unit's process, where anything may be written.
std::chrono::nanoseconds time_since(Clock::time_point began, Clock::time_point end) {
  return std::clamp(end, began, std::max(began, Clock::now())) - began;
}

}  // namespace

// ---- Life cycle ----

UnitProxy::UnitProxy(HostedUnitSpec spec) : spec_(std::move(spec)) {
  if (spec_.host.is_sandboxed) {
    spec_.temporary = std::make_unique<archive::TemporaryFolder>();
  }
  try {
    client_ = std::make_unique<HostClient>(spec_);
  } catch (const std::system_error& failure) {
    core::fail_run({.where = spec_.options.where, .unit = spec_.name},
                   fmt::format("there can be no process for it: {}", failure.what()));
  }
  call(
      RequestCode::Instantiate, [](PacketWriter&) {},
      [&](PacketReader& from) {
        protections_ = take_protections(from);
        capabilities_ = take_capabilities(from);
      });
  capabilities_.set(static_cast<std::size_t>(core::HostDiagnostics::kId));
  capabilities_.set(static_cast<std::size_t>(core::ConcurrentSteps::kId));
  if (spec_.has_snapshots()) {
    capabilities_.set(static_cast<std::size_t>(core::StateSaving::kId));
  }
}

core::Capability* UnitProxy::find_capability(core::CapabilityId id) {
  if (!capabilities_.test(static_cast<std::size_t>(id))) return nullptr;
  return implemented(id);
}

UnitProxy::~UnitProxy() {
  try {
    UnitProxy::free();
  } catch (const std::exception& failure) {
    client_->log(importer::Status::Warning, "stride",
                 fmt::format("its end failed: {}", failure.what()));
  }
  client_->finish();
}

void UnitProxy::free() {
  drop_step();
  if (std::exchange(is_freed_, true) || client_->has_failed()) return;
  call(RequestCode::Free);
  client_->finish();
}

void UnitProxy::terminate() {
  drop_step();
  if (!client_->has_failed()) call(RequestCode::Terminate);
}

core::HostStatistics UnitProxy::host_statistics() const {
  core::HostStatistics statistics = client_->statistics();
  statistics.protections = protections_.in_force;
  statistics.missing_protections = protections_.missing;
  return statistics;
}

// ---- Requests ----

template <class Put, class Take>
void UnitProxy::call(RequestCode request, Put&& put, Take&& take) {
  send(request, put);
  receive(take);
}

template <class Put>
void UnitProxy::send(RequestCode request, Put&& put) {
  guard([&] {
    PacketWriter packet = client_->write();
    put(packet);
    client_->post(request, packet, times_.now);
  });
}

template <class Take>
void UnitProxy::receive(Take&& take) {
  guard([&] {
    ReplyCode reply = client_->await(times_.now, spec_.host.call_limit);
    if (reply != ReplyCode::Done) [[unlikely]] {
      reply = serve_input_requests(reply);
      if (reply != ReplyCode::Done) throw_reply(reply);
    }
    PacketReader answer = client_->read();
    take(answer);
  });
}

template <class Action>
void UnitProxy::guard(Action&& action) {
  try {
    action();
  } catch (const BadPacket&) {
    client_->fail_bad_packet(times_.now);
  } catch (const std::system_error& failure) {
    core::fail_run({.where = spec_.options.where, .unit = spec_.name, .time = times_.now},
                   failure.what());
  }
}

template <class Put>
void UnitProxy::call(RequestCode request, Put&& put) {
  call(request, put, [](PacketReader&) {});
}

void UnitProxy::call(RequestCode request) {
  call(request, [](PacketWriter&) {});
}

ReplyCode UnitProxy::serve_input_requests(ReplyCode reply) {
  while (reply == ReplyCode::RequestInputs) {
    const bool are_set = input_update_.run(client_->read().take<double>());
    const RequestCode answer = are_set ? RequestCode::InputsUpdated : RequestCode::InputsNotUpdated;
    if (client_->has_failed()) return ReplyCode::CallbackFailed;
    reply = client_->send(answer, client_->write(), times_.now);
  }
  return reply;
}

void UnitProxy::throw_reply(ReplyCode reply) {
  if (reply == ReplyCode::CallbackFailed) input_update_.rethrow_failure();
  if (reply != ReplyCode::Failed) throw BadPacket();
  PacketReader error = client_->read();
  throw_error(error);
}

// ---- Modes ----

void UnitProxy::enter_configuration_mode() { call(RequestCode::EnterConfigurationMode); }

void UnitProxy::exit_configuration_mode() { call(RequestCode::ExitConfigurationMode); }

void UnitProxy::enter_initialization(Time start, std::optional<Time> stop) {
  times_.now = start;
  call(RequestCode::EnterInitialization, [&](PacketWriter& to) {
    put_time(to, start);
    put_time(to, stop);
  });
}

void UnitProxy::exit_initialization() { call(RequestCode::ExitInitialization); }

void UnitProxy::enter_event_mode() { call(RequestCode::EnterEventMode); }

void UnitProxy::enter_step_mode() { call(RequestCode::EnterStepMode); }

core::EventResult UnitProxy::update_discrete_states() {
  core::EventResult result;
  call(
      RequestCode::UpdateDiscreteStates, [](PacketWriter&) {},
      [&](PacketReader& from) { result = take_events(from); });
  return result;
}

// ---- Values ----

void UnitProxy::get(References references, core::ValueBlock& values) {
  call(
      RequestCode::Get,
      [&](PacketWriter& to) {
        to.put_all(references);
        put_shape(to, values);
      },
      [&](PacketReader& from) { take_values(from, values); });
}

void UnitProxy::set(References references, const core::ValueBlock& values) {
  call(RequestCode::Set, [&](PacketWriter& to) {
    to.put_all(references);
    put_shape(to, values);
    put_values(to, values);
  });
}

void UnitProxy::get_directional_derivative(References unknowns, References knowns,
                                           std::span<const double> seed,
                                           std::span<double> sensitivity) {
  call(
      RequestCode::GetDirectionalDerivative,
      [&](PacketWriter& to) {
        to.put_all(unknowns);
        to.put_all(knowns);
        to.put_all(seed);
        to.put(sensitivity.size());
      },
      [&](PacketReader& from) { from.take_into(sensitivity.data(), sensitivity.size_bytes()); });
}

// ---- Steps ----

core::StepResult UnitProxy::step(const core::StepInterval& interval) {
  return step(interval, core::StepValues{});
}

core::StepResult UnitProxy::step(const core::StepInterval& interval,
                                 const core::StepValues& values) {
  begin_step(interval, values, {});
  return finish_step();
}

void UnitProxy::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                           const Extras& extras) {
  const std::uint32_t plan = plan_number(values);
  times_.now = interval.from;
  send(RequestCode::Step, [&](PacketWriter& to) {
    to.put(plan);
    to.put(interval);
    to.put(extras.saves_state);
    to.put(extras.is_timed);
    for (const core::BoundValues& input : values.inputs) put_values(to, *input.block);
  });
  step_ = PresentStep{interval, values};
  if (extras.is_timed) step_->began = Clock::now();
  client_->begin_call();
}

core::StepResult UnitProxy::finish_step() {
  const PresentStep step = *std::exchange(step_, std::nullopt);
  core::StepResult result;
  receive([&](PacketReader& from) { result = take_result(from, step); });
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

/// Another unit has failed, and its error ends the run. A step that does not end is no reason to
/// wait for ever.
void UnitProxy::drop_step() noexcept {
  if (!std::exchange(step_, std::nullopt)) return;
  try {
    const auto limit = spec_.host.call_limit.value_or(spec_.options.warn_after);
    ReplyCode reply = client_->await(times_.now, limit);
    while (reply == ReplyCode::RequestInputs) {
      client_->post(RequestCode::InputsNotUpdated, client_->write(), times_.now);
      reply = client_->await(times_.now, limit);
    }
  } catch (const std::exception& failure) {
    client_->log(
        importer::Status::Warning, "stride",
        fmt::format("its step was dropped, since another unit had failed: {}", failure.what()));
  }
}

std::uint32_t UnitProxy::plan_number(const core::StepValues& values) {
  if (const auto known = plans_.find(values)) return *known;
  const std::uint32_t number = plans_.add(values);
  call(RequestCode::MakePlan, [&](PacketWriter& to) {
    to.put(number);
    put_shape(to, values);
  });
  return number;
}

void UnitProxy::set_input_update(core::InputUpdate update) {
  input_update_.set(std::move(update));
  call(RequestCode::SetInputUpdate, [&](PacketWriter& to) { to.put(input_update_.is_set()); });
}

// ---- States ----

void UnitProxy::save_state() {
  call(RequestCode::SaveState, [&](PacketWriter& to) { put_time(to, times_.now); });
  times_.note_saved();
}

/// A process that is taken back knows the plans of its time only.
void UnitProxy::restore_state() {
  if (spec_.has_snapshots()) plans_.forget();
  times_.go_back();
  call(RequestCode::RestoreState, [&](PacketWriter& to) { put_time(to, times_.now); });
}

void UnitProxy::select_state(std::size_t slot) {
  call(RequestCode::SelectState, [&](PacketWriter& to) { to.put(slot); });
  times_.select(slot);
}

std::vector<std::uint8_t> UnitProxy::serialize_state() {
  std::vector<std::uint8_t> bytes;
  call(
      RequestCode::SerializeState, [](PacketWriter&) {},
      [&](PacketReader& from) { bytes = from.take_all<std::uint8_t>(); });
  return bytes;
}

/// The bytes do not contain the time.
void UnitProxy::deserialize_state(std::span<const std::uint8_t> bytes) {
  call(RequestCode::DeserializeState, [&](PacketWriter& to) { to.put_all(bytes); });
  times_.note_unknown();
}

void UnitProxy::reset() {
  call(RequestCode::Reset);
  times_.now.reset();
  rejection_reason_.clear();
}

// ---- Clocks ----

core::ClockInterval UnitProxy::clock_interval(const core::Variable& clock) {
  core::ClockInterval given;
  call(
      RequestCode::GetClockInterval, [&](PacketWriter& to) { to.put(clock.reference); },
      [&](PacketReader& from) { given = take_clock(from); });
  return given;
}

core::Interval UnitProxy::clock_shift(const core::Variable& clock) {
  core::Interval shift;
  call(
      RequestCode::GetClockShift, [&](PacketWriter& to) { to.put(clock.reference); },
      [&](PacketReader& from) { shift = take_interval(from); });
  return shift;
}

// ---- Idle time ----

void UnitProxy::enable_idle_skipping(Duration max_skip) {
  call(RequestCode::EnableIdleSkipping, [&](PacketWriter& to) { to.put(max_skip.count()); });
}

void UnitProxy::set_idle_tolerances(References outputs, std::span<const double> tolerances) {
  call(RequestCode::SetIdleTolerances, [&](PacketWriter& to) {
    to.put_all(outputs);
    to.put_all(tolerances);
  });
}

Time UnitProxy::idle_until() {
  Time until = Time::min();
  call(
      RequestCode::GetIdleUntil, [](PacketWriter&) {},
      [&](PacketReader& from) { until = take_time(from).value_or(Time::min()); });
  return until;
}

void UnitProxy::get_derivatives(References outputs, std::span<double> derivatives) {
  call(
      RequestCode::GetDerivatives,
      [&](PacketWriter& to) {
        to.put_all(outputs);
        to.put(derivatives.size());
      },
      [&](PacketReader& from) { from.take_into(derivatives.data(), derivatives.size_bytes()); });
}

// ---- Messages in words ----

std::string UnitProxy::describe_message(core::ValueReference variable, const core::Binary& value) {
  std::string text;
  call(
      RequestCode::DescribeMessage,
      [&](PacketWriter& to) {
        to.put(variable);
        to.put_all(std::span(value));
      },
      [&](PacketReader& from) { text = from.take_text(); });
  return text;
}

}  // namespace stride::isolation
