#include "master/loader/process/server.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "master/base/child_process/process_memory.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/process/own_exit.h"
#include "master/base/process/process_state.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/loader/process/sandbox_hint.h"
#include "master/loader/wire/codec.h"

namespace stride::isolation {
namespace {

/// Where the master is so long in coming, nothing is lost by another look.
constexpr std::chrono::seconds kMasterCheckInterval{10};

/// What the master did within a call has failed; it knows how.
struct CallbackFailure {};

/// First among the functions that exit() calls, but for the unit's own: those of the master are not
/// for this process.
void on_exit_called(int status, void* server) {
  std::fflush(nullptr);
  const bool is_own = core::OwnExit::is_caller_of(__builtin_frame_address(0));
  if (is_own) static_cast<Server*>(server)->confirm_end();
  ::_exit(status);
}

void add(Protections& protections, Protections&& further) {
  std::ranges::move(further.in_force, std::back_inserter(protections.in_force));
  std::ranges::move(further.missing, std::back_inserter(protections.missing));
}

}  // namespace

void serve(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor) noexcept {
  reset_signal_handlers();
  ::prctl(PR_SET_NAME, spec.name.c_str());
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a crash loses no line
  Server server(link, spec, supervisor);
  ::on_exit(&on_exit_called, &server);
  server.run();
  core::OwnExit::begin();
  std::exit(0);
}

Server::Server(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor)
    : link_(link), memory_(*link.memory), spec_(spec), log_(*link.memory) {
  if (!spec.has_snapshots()) return;
  snapshots_.emplace(
      memory_.snapshots, memory_.active, supervisor,
      SnapshotOptions{context(), {link.packets.file().number()}, spec.host.memory_limit});
}

void Server::run() {
  while (!is_over_) {
    await_request();
    serve();
  }
  memory_.call_note.write("an exit function of its library");
}

void Server::confirm_end() {
  if (is_over_) reply(ReplyCode::Done, PacketWriter(link_.packets));
}

Protections Server::prepare() {
  Protections protections;
  if (spec_.host.memory_limit) {
    limit_memory(*spec_.host.memory_limit);
    protections.in_force.push_back(fmt::format(
        "at most {} MiB of memory: RLIMIT_DATA for each process, a watch over the sum of all",
        *spec_.host.memory_limit >> 20));
  }
  if (!spec_.host.is_sandboxed) return protections;
  ::setenv("TMPDIR", spec_.temporary->path().c_str(), 1);
  add(protections, enter_sandbox(writable_folders(spec_), spec_.host.memory_limit.has_value()));
  return protections;
}

// ---- Requests and replies ----

void Server::await_request() {
  const auto is_there = [&] {
    return memory_.request.number.load(std::memory_order_acquire) !=
           memory_.reply.number.load(std::memory_order_relaxed);
  };
  while (!waiter_.wait(memory_.request.doorbell, kMasterCheckInterval, is_there)) {
  }
}

RequestCode Server::requested() const {
  return static_cast<RequestCode>(memory_.request.what.load());
}

void Server::serve() {
  const std::size_t size = memory_.request.size;
  link_.packets.follow(size);
  PacketReader in({link_.packets.data(), size});
  PacketWriter out(link_.packets);
  ReplyCode what = ReplyCode::Done;
  const auto fail = [&](const core::Error& error) {
    what = ReplyCode::Failed;
    out.clear();
    put_error(out, error, context(), sandbox_hint(error.what(), spec_.name, spec_.host));
  };
  try {
    handle(requested(), in, out);
  } catch (const CallbackFailure&) {
    what = ReplyCode::CallbackFailed;
  } catch (const core::Error& error) {
    fail(error);
  } catch (const std::exception& error) {
    fail(error_of(error));
  } catch (...) {
    fail(error_of(std::runtime_error("something that is not a std::exception")));
  }
  if (!is_over_) reply(what, out);
}

template <core::CapabilityInterface C>
C& Server::capability() const {
  core::Capability* const found = capabilities_.at(static_cast<std::size_t>(C::kId));
  if (found == nullptr) throw BadPacket();  // the master asks for none that the unit lacks
  return static_cast<C&>(*found);
}

void Server::reply(ReplyCode what, const PacketWriter& packet) {
  memory_.call_note.clear();
  if (diagnostics_ != nullptr) {
    memory_.calls.store(undone_calls_ + diagnostics_->calls(), std::memory_order_relaxed);
  }
  memory_.reply.what.store(static_cast<std::uint32_t>(what), std::memory_order_relaxed);
  memory_.reply.size.store(packet.size(), std::memory_order_relaxed);
  memory_.reply.number.store(memory_.request.number.load(std::memory_order_relaxed),
                             std::memory_order_release);
  memory_.reply.doorbell.ring();
}

void Server::handle(RequestCode request, PacketReader& in, PacketWriter& out) {
  switch (request) {
    case RequestCode::Instantiate:
      return instantiate(out);
    case RequestCode::EnterConfigurationMode:
      return capability<core::ConfigurationMode>().enter_configuration_mode();
    case RequestCode::ExitConfigurationMode:
      return capability<core::ConfigurationMode>().exit_configuration_mode();
    case RequestCode::EnterInitialization: {
      time_ = take_time(in);
      if (!time_) throw BadPacket();
      return unit_->enter_initialization(*time_, take_time(in));
    }
    case RequestCode::ExitInitialization:
      return unit_->exit_initialization();
    case RequestCode::Get:
      return get(in, out);
    case RequestCode::Set:
      return set(in);
    case RequestCode::MakePlan:
      return make_plan(in);
    case RequestCode::Step:
      return step(in, out);
    case RequestCode::SaveState:
      save_state(take_time(in));
      return;
    case RequestCode::RestoreState:
      return restore_state(in);
    case RequestCode::SelectState:
      return select_state(in.take<std::size_t>());
    case RequestCode::SerializeState:
      return out.put_all(
          std::span<const std::uint8_t>(capability<core::StateSerialization>().serialize_state()));
    case RequestCode::DeserializeState:
      return capability<core::StateSerialization>().deserialize_state(in.take_all<std::uint8_t>());
    case RequestCode::Reset:
      return capability<core::Resetting>().reset();
    case RequestCode::EnterEventMode:
      return unit_->enter_event_mode();
    case RequestCode::UpdateDiscreteStates:
      return put_events(out, unit_->update_discrete_states());
    case RequestCode::EnterStepMode:
      return unit_->enter_step_mode();
    case RequestCode::GetClockInterval:
      return put_clock(out, capability<core::ClockIntervals>().clock_interval(
                                variable(in.take<core::ValueReference>())));
    case RequestCode::GetClockShift:
      return put_interval(out, capability<core::ClockIntervals>().clock_shift(
                                   variable(in.take<core::ValueReference>())));
    case RequestCode::GetDirectionalDerivative:
      return get_directional_derivative(in, out);
    case RequestCode::SetInputUpdate:
      return set_input_update(in.take<bool>());
    case RequestCode::EnableIdleSkipping:
      return capability<core::IdlePromises>().enable_idle_skipping(
          Duration(in.take<Duration::rep>()));
    case RequestCode::SetIdleTolerances:
      return set_idle_tolerances(in);
    case RequestCode::GetIdleUntil:
      return put_time(out, capability<core::IdlePromises>().idle_until());
    case RequestCode::GetDerivatives:
      return get_derivatives(in, out);
    case RequestCode::DescribeMessage:
      return describe_message(in, out);
    case RequestCode::Terminate:
      return unit_->terminate();
    case RequestCode::Free:
      return free();
    case RequestCode::InputsUpdated:
    case RequestCode::InputsNotUpdated:
      break;
  }
  throw BadPacket();
}

core::Context Server::context() const {
  return {.where = spec_.options.where, .unit = spec_.name, .variable = {}, .time = time_};
}

/// Of an exception that has crossed the unit's interface, which none may, or of this process
/// itself.
core::Error Server::error_of(const std::exception& error) const {
  const std::string function(memory_.call_note.function());
  std::string text = error.what();
  if (!function.empty()) {
    text = fmt::format("{} let an exception out: {}", function, text);
  } else if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
             dynamic_cast<const std::length_error*>(&error) != nullptr) {
    text = "there is not enough memory for what was requested of it";
  }
  return {core::Error::Kind::Run, context(), text};
}

// ---- Life cycle ----

void Server::instantiate(PacketWriter& out) {
  put_protections(out, prepare());
  importer::InstanceOptions options = spec_.options;
  options.call_note = &memory_.call_note;
  options.process = std::make_shared<core::ProcessState>(core::ProcessState::Extent::Numbers);
  options.log = [this](const std::string&, importer::Status status, const std::string& category,
                       const std::string& text) {
    log_.write({status, category, text});
  };
  memory_.call_note.write("the loading of its library");
  unit_ = spec_.fmu->instantiate(spec_.name, std::move(options));
  CapabilitySet found;
  for (std::size_t i = 0; i < capabilities_.size(); ++i) {
    capabilities_[i] = unit_->capability(static_cast<core::CapabilityId>(i));
    found.set(i, capabilities_[i] != nullptr);
  }
  diagnostics_ = &capability<core::UnitDiagnostics>();
  put_capabilities(out, found);
}

void Server::free() {
  diagnostics_ = nullptr;
  if (unit_) unit_->free();
  unit_.reset();
  memory_.call_note.write("the unloading of its library");
  spec_.fmu->unload_library();
  std::fflush(nullptr);
  is_over_ = true;
}

// ---- Values ----

void Server::get(PacketReader& in, PacketWriter& out) {
  const auto references = in.take_all<core::ValueReference>();
  core::ValueBlock values = take_shape(in);
  unit_->get(references, values);
  put_values(out, values);
}

void Server::set(PacketReader& in) {
  const auto references = in.take_all<core::ValueReference>();
  core::ValueBlock values = take_shape(in);
  take_values(in, values);
  unit_->set(references, values);
}

void Server::get_directional_derivative(PacketReader& in, PacketWriter& out) {
  const auto unknowns = in.take_all<core::ValueReference>();
  const auto knowns = in.take_all<core::ValueReference>();
  const auto seed = in.take_all<double>();
  std::vector<double> sensitivity(in.take<std::size_t>());
  capability<core::DirectionalDerivatives>().get_directional_derivative(unknowns, knowns, seed,
                                                                        sensitivity);
  out.put_bytes(sensitivity.data(), sensitivity.size() * sizeof(double));
}

const core::Variable& Server::variable(core::ValueReference reference) const {
  const core::UnitDescription& description =
      spec_.options.description ? *spec_.options.description : *spec_.fmu->description();
  const auto found = description.find(reference);
  if (!found) throw BadPacket();
  return description.variables[*found];
}

// ---- Steps ----

void Server::make_plan(PacketReader& in) {
  StepBuffers& made = plan(in);
  made = StepBuffers(take_step_shape(in));
}

StepBuffers& Server::plan(PacketReader& in) {
  const auto number = in.take<std::uint32_t>();
  if (number >= plans_.size()) throw BadPacket();
  return plans_[number];
}

void Server::step(PacketReader& in, PacketWriter& out) {
  StepBuffers& buffers = plan(in);
  const auto interval = in.take<core::StepInterval>();
  const bool saves_state = in.take<bool>();
  const bool is_timed = in.take<bool>();
  buffers.take_inputs(in);
  time_ = interval.from;
  core::StepValues values = buffers.values();
  if (saves_state) {
    for (const core::BoundValues& input : values.inputs) {
      unit_->set(input.references, *input.block);
    }
    values.inputs = {};
    if (save_state(interval.from)) return;
  }
  const core::StepResult result = unit_->step(interval, values);
  if (!result.rejected) time_ = result.reached;
  put_step(out, result);
  if (is_timed) out.put(std::chrono::steady_clock::now());
  if (result.rejected) {
    out.put(diagnostics_->rejection_reason());
  } else {
    buffers.put_outputs(out);
  }
}

void Server::set_input_update(bool is_set) {
  core::InputUpdate update;
  if (is_set) update = [this](double seconds) { request_inputs(seconds); };
  capability<core::InputsWithinStep>().set_input_update(std::move(update));
}

/// The master may get and set before it answers.
void Server::request_inputs(double seconds_into_step) {
  PacketWriter question(link_.packets);
  question.put(seconds_into_step);
  reply(ReplyCode::RequestInputs, question);
  for (await_request(); requested() != RequestCode::InputsUpdated; await_request()) {
    if (requested() == RequestCode::InputsNotUpdated) throw CallbackFailure();
    serve();
  }
}

// ---- States ----

/// With snapshots it returns once more for each restored state, in the process that goes on then:
/// true, and the request is one to restore.
bool Server::save_state(std::optional<Time> time) {
  if (!snapshots_) {
    capability<core::StateSaving>().save_state();
    return false;
  }
  memory_.call_note.write("the snapshot of its process");
  if (!snapshots_->save(slot_, time)) return false;
  undone_calls_ = memory_.calls - diagnostics_->calls();
  return true;
}

void Server::restore_state(PacketReader& in) {
  const std::optional<Time> time = take_time(in);
  if (!snapshots_) {
    capability<core::StateSaving>().restore_state();
    time_ = time;
    return;
  }
  memory_.call_note.write("the return to a snapshot of its process");
  snapshots_->restore(slot_, time);
}

void Server::select_state(std::size_t slot) {
  if (!snapshots_) return capability<core::StateSaving>().select_state(slot);
  slot_ = slot;
}

// ---- Idle time ----

void Server::set_idle_tolerances(PacketReader& in) {
  const auto outputs = in.take_all<core::ValueReference>();
  capability<core::IdlePromises>().set_idle_tolerances(outputs, in.take_all<double>());
}

void Server::get_derivatives(PacketReader& in, PacketWriter& out) {
  const auto outputs = in.take_all<core::ValueReference>();
  std::vector<double> derivatives(in.take<std::size_t>());
  capability<core::IdlePromises>().get_derivatives(outputs, derivatives);
  out.put_bytes(derivatives.data(), derivatives.size() * sizeof(double));
}

void Server::describe_message(PacketReader& in, PacketWriter& out) {
  const auto variable = in.take<core::ValueReference>();
  const core::Binary value = in.take_all<core::Binary::value_type>();
  out.put(capability<core::MessageText>().describe_message(variable, value));
}

}  // namespace stride::isolation
