#include "master/loader/network/server/unit_server.h"

#include <utility>

#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/loader/network/codec.h"

namespace stride::remote {

UnitServer::UnitServer(ServerChannel& channel, const ServeOptions& options)
    : channel_(channel),
      options_(options),
      offer_(options.only, options.file_limit, options.find) {}

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

}  // namespace stride::remote
