#include "master/remote/unit_server.h"

#include <algorithm>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "master/algorithm/capabilities/clock_intervals.h"
#include "master/algorithm/capabilities/configuration_mode.h"
#include "master/algorithm/capabilities/directional_derivatives.h"
#include "master/algorithm/capabilities/idle_promises.h"
#include "master/algorithm/capabilities/inputs_within_step.h"
#include "master/algorithm/capabilities/message_text.h"
#include "master/algorithm/capabilities/resetting.h"
#include "master/algorithm/capabilities/state_saving.h"
#include "master/algorithm/capabilities/state_serialization.h"
#include "master/isolation/hosted_unit.h"
#include "master/remote/codec.h"
#include "master/remote/description_files.h"
#include "master/remote/unit_files.h"

namespace stride::remote {
namespace {

/// What the master did for the unit within a step has failed; it knows how.
struct CallbackFailure {};

/// The smaller of two limits, where there are some.
template <class T>
std::optional<T> least(std::optional<T> a, std::optional<T> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

template <class T>
std::optional<T> above_zero(std::uint64_t number) {
  return number == 0 ? std::nullopt : std::optional<T>(number);
}

isolation::HostOptions host_options(wire::Instantiate::Reader from, const ServeOptions& options) {
  constexpr std::uint64_t kLongest = 1'000'000'000'000;  // [ms]
  isolation::HostOptions host;
  host.call_limit =
      least(above_zero<std::chrono::milliseconds>(std::min(from.getCallLimit(), kLongest)),
            options.call_limit);
  host.memory_limit = least(above_zero<std::uint64_t>(from.getMemoryLimit()), options.memory_limit);
  host.is_sandboxed = from.getIsSandboxed() || !options.may_leave_sandbox;
  host.takes_snapshots = from.getTakesSnapshots();
  return host;
}

}  // namespace

UnitServer::UnitServer(ServerChannel& channel, const ServeOptions& options)
    : channel_(channel),
      options_(options),
      offer_(options.only, options.accepts_files, options.find) {}

void UnitServer::run() {
  for (;;) {
    with_checked_messages([&] {
      IncomingMessage message(channel_.receive());
      serve(message.root<wire::Request>());
    });
  }
}

// ---- Requests and answers ----

void UnitServer::serve(wire::Request::Reader request) {
  const bool is_awaited = request.getIsAwaited();
  if (failure_ && !is_awaited) return;
  began_ = Clock::now();
  channel_.set_busy(true);
  try {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    handle(request);
  } catch (const LinkEnded&) {
    throw;
  } catch (const BadMessage&) {
    throw;
  } catch (const kj::Exception&) {
    throw;
  } catch (const CallbackFailure&) {
    channel_.send([](wire::Reply::Builder reply) { reply.setCallbackFailed(); });
  } catch (const std::exception& error) {
    if (is_awaited) {
      answer_failure(error);
    } else {
      failure_ = std::current_exception();
    }
  }
  channel_.set_busy(false);
}

template <class Fill>
void UnitServer::answer(Fill&& fill) {
  channel_.send([&](wire::Reply::Builder reply) {
    auto result = reply.initDone();
    if (diagnostics_ != nullptr) result.setCalls(diagnostics_->calls());
    result.setNanoseconds(
        static_cast<std::uint64_t>(std::chrono::nanoseconds(Clock::now() - began_).count()));
    fill(result);
  });
}

void UnitServer::answer() {
  answer([](wire::Result::Builder result) { result.setNone(); });
}

void UnitServer::answer_failure(const std::exception& error) {
  channel_.send(
      [&](wire::Reply::Builder reply) { put_error(reply.initFailed(), error, context()); });
}

void UnitServer::handle(wire::Request::Reader request) {
  switch (request.which()) {
    case wire::Request::PING:
      return answer();
    case wire::Request::DESCRIBE:
      return describe(to_string(request.getDescribe()));
    case wire::Request::SEND_FILE: {
      const auto piece = request.getSendFile();
      const auto bytes = piece.getBytes().asChars();
      offer_.take_piece(to_string(piece.getName()), {bytes.begin(), bytes.size()},
                        piece.getIsFirst());
      break;
    }
    case wire::Request::INSTANTIATE:
      return instantiate(request.getInstantiate());
    case wire::Request::GET:
      return get(request.getGet());
    case wire::Request::SET:
      set(request.getSet());
      break;
    case wire::Request::MAKE_PLAN:
      make_plan(request.getMakePlan());
      break;
    case wire::Request::STEP:
      return step(request.getStep());
    case wire::Request::GET_DIRECTIONAL_DERIVATIVE:
      return get_directional_derivative(request.getGetDirectionalDerivative());
    case wire::Request::SET_INPUT_UPDATE:
      set_input_update(request.getSetInputUpdate());
      break;
    case wire::Request::DESCRIBE_MESSAGE: {
      const auto asked = request.getDescribeMessage();
      const auto value = asked.getValue();
      const std::string text = capability<core::MessageText>().describe_message(
          asked.getVariable(), {value.begin(), value.end()});
      return answer([&](wire::Result::Builder result) { result.setText(text); });
    }
    case wire::Request::SET_REPEATING:
      if (diagnostics_ != nullptr) diagnostics_->set_repeating(request.getSetRepeating());
      break;
    case wire::Request::GET_STATISTICS:
      return send_statistics();
    case wire::Request::FREE:
      return free();
    case wire::Request::GET_FILES:
      return send_files();
    case wire::Request::INPUTS_UPDATED:
    case wire::Request::INPUTS_NOT_UPDATED:
      throw BadMessage("inputs came that nobody has asked for");
    default:
      return handle_mode(request);
  }
  if (request.getIsAwaited()) answer();
}

void UnitServer::handle_mode(wire::Request::Reader request) {
  switch (request.which()) {
    case wire::Request::ENTER_CONFIGURATION_MODE:
      capability<core::ConfigurationMode>().enter_configuration_mode();
      break;
    case wire::Request::EXIT_CONFIGURATION_MODE:
      capability<core::ConfigurationMode>().exit_configuration_mode();
      break;
    case wire::Request::ENTER_INITIALIZATION: {
      const auto times = request.getEnterInitialization();
      time_ = to_time(times.getStart());
      unit().enter_initialization(*time_, take_time(times.getStop()));
      break;
    }
    case wire::Request::EXIT_INITIALIZATION:
      unit().exit_initialization();
      break;
    case wire::Request::ENTER_EVENT_MODE:
      unit().enter_event_mode();
      break;
    case wire::Request::UPDATE_DISCRETE_STATES: {
      const core::EventResult events = unit().update_discrete_states();
      return answer([&](wire::Result::Builder to) { put_events(to.initEvents(), events); });
    }
    case wire::Request::ENTER_STEP_MODE:
      unit().enter_step_mode();
      break;
    case wire::Request::TERMINATE:
      unit().terminate();
      break;
    default:
      return handle_state(request);
  }
  if (request.getIsAwaited()) answer();
}

void UnitServer::handle_state(wire::Request::Reader request) {
  switch (request.which()) {
    case wire::Request::SAVE_STATE:
      capability<core::StateSaving>().save_state();
      break;
    case wire::Request::RESTORE_STATE:
      capability<core::StateSaving>().restore_state();
      break;
    case wire::Request::SELECT_STATE:
      if (request.getSelectState() > 1'000'000) throw BadMessage("there is no such state");
      capability<core::StateSaving>().select_state(request.getSelectState());
      break;
    case wire::Request::SERIALIZE_STATE: {
      const auto bytes = capability<core::StateSerialization>().serialize_state();
      return answer(
          [&](wire::Result::Builder to) { to.setBytes(to_data(bytes.data(), bytes.size())); });
    }
    case wire::Request::DESERIALIZE_STATE: {
      const auto bytes = request.getDeserializeState();
      capability<core::StateSerialization>().deserialize_state({bytes.begin(), bytes.size()});
      break;
    }
    case wire::Request::RESET:
      capability<core::Resetting>().reset();
      break;
    default:
      return handle_clock(request);
  }
  if (request.getIsAwaited()) answer();
}

void UnitServer::handle_clock(wire::Request::Reader request) {
  core::ClockInterval clock;
  switch (request.which()) {
    case wire::Request::GET_CLOCK_INTERVAL:
      clock = capability<core::ClockIntervals>().clock_interval(
          variable(request.getGetClockInterval()));
      break;
    case wire::Request::GET_CLOCK_SHIFT:
      clock.interval =
          capability<core::ClockIntervals>().clock_shift(variable(request.getGetClockShift()));
      break;
    default:
      return handle_idle(request);
  }
  answer([&](wire::Result::Builder to) { put_clock(to.initClock(), clock); });
}

void UnitServer::handle_idle(wire::Request::Reader request) {
  switch (request.which()) {
    case wire::Request::ENABLE_IDLE_SKIPPING:
      capability<core::IdlePromises>().enable_idle_skipping(
          Duration(request.getEnableIdleSkipping()));
      break;
    case wire::Request::SET_IDLE_TOLERANCES:
      set_idle_tolerances(request.getSetIdleTolerances());
      break;
    case wire::Request::GET_IDLE_UNTIL: {
      const Time until = capability<core::IdlePromises>().idle_until();
      return answer([&](wire::Result::Builder to) { to.setTime(to_wire(until)); });
    }
    case wire::Request::GET_DERIVATIVES:
      return get_derivatives(request.getGetDerivatives());
    default:
      core::fail_run(context(),
                     fmt::format("request {} is not known here: stride {} is older than "
                                 "that of the master",
                                 static_cast<unsigned>(request.which()), own_greeting().build));
  }
  if (request.getIsAwaited()) answer();
}

// ---- Life cycle ----

core::Unit& UnitServer::unit() const {
  if (!unit_) throw BadMessage("a unit is called that is not there");
  return *unit_;
}

template <core::CapabilityInterface C>
C& UnitServer::capability() const {
  C* const found = unit().capability<C>();
  if (found == nullptr) throw BadMessage("a unit is asked for what it cannot");
  return *found;
}

const core::Variable& UnitServer::variable(core::ValueReference reference) const {
  const auto found = description_ ? description_->find(reference) : std::nullopt;
  if (!found) throw BadMessage(fmt::format("the unit has no variable {}", reference));
  return description_->variables[*found];
}

core::Context UnitServer::context() const {
  return {.where = {}, .unit = name_, .variable = {}, .time = time_};
}

void UnitServer::describe(const std::string& name) {
  const auto fmu = offer_.fmu(name);
  const std::vector<importer::DescriptionFile> files = fmu->description_files();
  answer([&](wire::Result::Builder result) {
    auto description = result.initDescription();
    description.setPath(fmu->path().string());
    auto list = description.initFiles(static_cast<unsigned>(files.size()));
    for (unsigned i = 0; i < list.size(); ++i) {
      list[i].setName(files[i].name);
      list[i].setBytes(to_data(files[i].text.data(), files[i].text.size()));
      list[i].setIsFirst(true);
    }
  });
}

/// As the master has it: arrays of the sizes that its structural parameters give.
std::shared_ptr<const core::UnitDescription> UnitServer::description_for(
    wire::Instantiate::Reader from) {
  const auto fmu = offer_.fmu(to_string(from.getFmu()));
  if (description_digest(fmu->description_files()) != to_string(from.getDigest())) {
    core::fail_input(
        {.unit = name_},
        fmt::format("'{}' there has changed since its description was read", fmu->path().string()),
        "start the run again");
  }
  auto description = std::make_shared<core::UnitDescription>(*fmu->description());
  for (const auto size : from.getSizes()) {
    if (!description->find(size.getParameter()) ||
        description->resize(size.getParameter(), size.getElements()) != nullptr) {
      throw BadMessage("an array has no such size");
    }
  }
  description->can_save_state &= from.getCanSaveState();
  description->can_serialize_state &= from.getCanSerializeState();
  return description;
}

void UnitServer::instantiate(wire::Instantiate::Reader from) {
  if (unit_) throw BadMessage("there is a unit already");
  name_ = to_string(from.getName());
  description_ = description_for(from);
  results_.emplace();
  importer::InstanceOptions options;
  options.early_return_allowed = from.getEarlyReturnAllowed();
  options.intermediate_update = from.getIntermediateUpdate();
  options.may_go_back = from.getMayGoBack();
  options.debug_logging = from.getDebugLogging();
  if (from.getStep().getIsThere()) options.step = Duration(from.getStep().getTime());
  options.interrupted = &channel_.is_over();
  options.log = [this](const std::string&, importer::Status status, const std::string& category,
                       const std::string& text) {
    channel_.send([&](wire::Reply::Builder reply) {
      auto log = reply.initLog();
      log.setStatus(static_cast<std::uint8_t>(status));
      log.setCategory(category);
      log.setText(text);
    });
  };
  options.where = {to_string(from.getFile()), from.getLine()};
  options.results = results_->path();
  options.description = description_;
  isolation::HostOptions host = host_options(from, options_);
  host.writable.push_back(results_->path());
  unit_ = isolation::instantiate(offer_.fmu(to_string(from.getFmu())), name_, std::move(options),
                                 std::move(host));
  diagnostics_ = unit_->capability<core::UnitDiagnostics>();
  host_ = unit_->capability<core::HostDiagnostics>();
  isolation::CapabilitySet capabilities;
  for (std::size_t i = 0; i < capabilities.size(); ++i) {
    capabilities.set(i, unit_->capability(static_cast<core::CapabilityId>(i)) != nullptr);
  }
  answer([&](wire::Result::Builder result) {
    auto instance = result.initInstance();
    put_capabilities(instance, capabilities);
    put_protections(instance, host_->host_statistics());
  });
}

void UnitServer::free() {
  unit().free();
  answer();
}

void UnitServer::send_statistics() {
  unit();
  const core::HostStatistics statistics = host_->host_statistics();
  answer(
      [&](wire::Result::Builder result) { put_statistics(result.initStatistics(), statistics); });
}

/// Those that cannot be sent are said.
void UnitServer::send_files() {
  std::string left_out;
  if (results_) {
    left_out = read_unit_files(results_->path(),
                               [&](const std::string& name, std::string_view bytes, bool is_first) {
                                 channel_.send([&](wire::Reply::Builder reply) {
                                   auto piece = reply.initFile();
                                   piece.setName(name);
                                   piece.setBytes(to_data(bytes.data(), bytes.size()));
                                   piece.setIsFirst(is_first);
                                 });
                               });
  }
  answer([&](wire::Result::Builder result) { result.setText(left_out); });
}

// ---- Values ----

void UnitServer::get(wire::Block::Reader block) {
  core::Unit& unit = this->unit();
  const isolation::StepShape::Group group = take_block(block, *description_);
  core::ValueBlock values(group.type, group.size);
  unit.get(group.references, values);
  answer([&](wire::Result::Builder result) { put_values(result.initValues(), values); });
}

void UnitServer::set(wire::Request::Set::Reader from) {
  core::Unit& unit = this->unit();
  const isolation::StepShape::Group group = take_block(from.getBlock(), *description_);
  core::ValueBlock values(group.type, group.size);
  take_values(from.getValues(), values);
  unit.set(group.references, values);
}

void UnitServer::get_directional_derivative(wire::Request::GetDirectionalDerivative::Reader from) {
  auto& derivatives = capability<core::DirectionalDerivatives>();
  const References unknowns = take_references(from.getUnknowns());
  const References knowns = take_references(from.getKnowns());
  std::vector<double> seed(element_count(knowns, *description_));
  take_doubles(from.getSeed(), seed);
  std::vector<double> sensitivity(element_count(unknowns, *description_));
  derivatives.get_directional_derivative(unknowns, knowns, seed, sensitivity);
  answer([&](wire::Result::Builder result) { result.setNumbers(to_data(sensitivity)); });
}

// ---- Steps ----

void UnitServer::make_plan(wire::Plan::Reader plan) {
  unit();
  if (plan.getNumber() >= plans_.size()) throw BadMessage("there is no such plan of a step");
  isolation::StepShape shape;
  for (const auto block : plan.getInputs()) {
    shape.inputs.push_back(take_block(block, *description_));
  }
  for (const auto block : plan.getOutputs()) {
    shape.outputs.push_back(take_block(block, *description_));
  }
  plans_[plan.getNumber()] = isolation::StepBuffers(shape);
}

void UnitServer::step(wire::Step::Reader from) {
  core::Unit& unit = this->unit();
  if (from.getPlan() >= plans_.size()) throw BadMessage("there is no such plan of a step");
  const core::StepValues values = plans_[from.getPlan()].values();
  take_values(from.getInputs(), values.inputs);
  const core::StepInterval interval = take_interval(from);
  time_ = interval.from;
  const core::StepResult result =
      from.getSavesState() ? capability<core::StateSaving>().save_with_step(unit, interval, values)
                           : unit.step(interval, values);
  if (!result.rejected) time_ = result.reached;
  answer([&](wire::Result::Builder to) {
    auto step = to.initStep();
    put_result(step, result);
    if (result.rejected) {
      step.setReason(diagnostics_->rejection_reason());
    } else {
      put_values(step.initOutputs(), values.outputs);
    }
  });
}

void UnitServer::set_input_update(bool is_set) {
  core::InputUpdate update;
  if (is_set) update = [this](double seconds) { request_inputs(seconds); };
  capability<core::InputsWithinStep>().set_input_update(std::move(update));
}

/// The master may get and set before it answers.
void UnitServer::request_inputs(double seconds_into_step) {
  const Clock::time_point began = began_;
  channel_.send([&](wire::Reply::Builder reply) { reply.setInputsNeeded(seconds_into_step); });
  for (;;) {
    IncomingMessage message(channel_.receive());
    const auto request = message.root<wire::Request>();
    if (request.isInputsUpdated()) break;
    if (request.isInputsNotUpdated()) throw CallbackFailure();
    serve(request);
    channel_.set_busy(true);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  began_ = began;
}

// ---- Idle time ----

void UnitServer::set_idle_tolerances(wire::Request::SetIdleTolerances::Reader from) {
  auto& promises = capability<core::IdlePromises>();
  const References outputs = take_references(from.getOutputs());
  const std::vector<double> tolerances = take_doubles(from.getTolerances());
  if (tolerances.size() != outputs.size()) throw BadMessage("tolerances are missing");
  promises.set_idle_tolerances(outputs, tolerances);
}

void UnitServer::get_derivatives(capnp::List<std::uint32_t>::Reader from) {
  auto& promises = capability<core::IdlePromises>();
  const References outputs = take_references(from);
  std::vector<double> derivatives(element_count(outputs, *description_));
  promises.get_derivatives(outputs, derivatives);
  answer([&](wire::Result::Builder result) { result.setNumbers(to_data(derivatives)); });
}

}  // namespace stride::remote
