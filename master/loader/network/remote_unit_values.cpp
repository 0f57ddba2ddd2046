// The modes, values, states, clocks and promises of a unit on another machine.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/loader/network/codec.h"
#include "master/loader/network/remote_unit.h"

namespace stride::remote {

// ---- Modes ----

void RemoteUnit::enter_configuration_mode() {
  defer([](wire::Request::Builder request) { request.setEnterConfigurationMode(); });
}

void RemoteUnit::exit_configuration_mode() {
  call("the configuration mode",
       [](wire::Request::Builder request) { request.setExitConfigurationMode(); });
}

void RemoteUnit::enter_initialization(Time start, std::optional<Time> stop) {
  times_.now = start;
  call("the initialization", [&](wire::Request::Builder request) {
    auto times = request.initEnterInitialization();
    times.setStart(to_wire(start));
    put_time(times.initStop(), stop);
  });
}

void RemoteUnit::exit_initialization() {
  call("the initialization",
       [](wire::Request::Builder request) { request.setExitInitialization(); });
}

void RemoteUnit::enter_event_mode() {
  defer([](wire::Request::Builder request) { request.setEnterEventMode(); });
}

void RemoteUnit::enter_step_mode() {
  defer([](wire::Request::Builder request) { request.setEnterStepMode(); });
}

core::EventResult RemoteUnit::update_discrete_states() {
  core::EventResult events;
  call(
      "an event", [](wire::Request::Builder request) { request.setUpdateDiscreteStates(); },
      [&](wire::Result::Reader result) {
        if (!result.isEvents()) throw BadMessage("an answer of another kind");
        events = take_events(result.getEvents());
      });
  return events;
}

// ---- Values ----

void RemoteUnit::get(References references, core::ValueBlock& values) {
  call(
      "the reading of values",
      [&](wire::Request::Builder request) { put_block(request.initGet(), references, values); },
      [&](wire::Result::Reader result) { take_values(result.getValues(), values); });
}

void RemoteUnit::set(References references, const core::ValueBlock& values) {
  defer([&](wire::Request::Builder request) {
    auto set = request.initSet();
    put_block(set.initBlock(), references, values);
    put_values(set.initValues(), values);
  });
}

void RemoteUnit::get_directional_derivative(References unknowns, References knowns,
                                            std::span<const double> seed,
                                            std::span<double> sensitivity) {
  call(
      "a derivative",
      [&](wire::Request::Builder request) {
        auto asked = request.initGetDirectionalDerivative();
        put_references(asked.initUnknowns(static_cast<unsigned>(unknowns.size())), unknowns);
        put_references(asked.initKnowns(static_cast<unsigned>(knowns.size())), knowns);
        asked.setSeed(to_data(seed));
      },
      [&](wire::Result::Reader result) { take_doubles(result.getNumbers(), sensitivity); });
}

// ---- States ----

void RemoteUnit::save_state() {
  defer([](wire::Request::Builder request) { request.setSaveState(); });
  times_.note_saved();
}

void RemoteUnit::restore_state() {
  times_.go_back();
  defer([](wire::Request::Builder request) { request.setRestoreState(); });
}

void RemoteUnit::select_state(std::size_t slot) {
  defer([&](wire::Request::Builder request) {
    request.setSelectState(static_cast<std::uint32_t>(slot));
  });
  times_.select(slot);
}

std::vector<std::uint8_t> RemoteUnit::serialize_state() {
  std::vector<std::uint8_t> bytes;
  call(
      "the serialization of its state",
      [](wire::Request::Builder request) { request.setSerializeState(); },
      [&](wire::Result::Reader result) {
        const auto from = result.getBytes();
        bytes.assign(from.begin(), from.end());
      });
  return bytes;
}

/// The bytes do not contain the time.
void RemoteUnit::deserialize_state(std::span<const std::uint8_t> bytes) {
  call("the deserialization of its state", [&](wire::Request::Builder request) {
    request.setDeserializeState(to_data(bytes.data(), bytes.size()));
  });
  times_.note_unknown();
}

void RemoteUnit::reset() {
  call("the reset", [](wire::Request::Builder request) { request.setReset(); });
  times_.now.reset();
  rejection_reason_.clear();
}

void RemoteUnit::set_repeating(bool repeating) {
  if (!connection_ || connection_->has_failed()) return;
  defer([&](wire::Request::Builder request) { request.setSetRepeating(repeating); });
}

// ---- Clocks ----

core::ClockInterval RemoteUnit::clock_interval(const core::Variable& clock) {
  core::ClockInterval given;
  call(
      "the interval of a clock",
      [&](wire::Request::Builder request) { request.setGetClockInterval(clock.reference); },
      [&](wire::Result::Reader result) { given = take_clock(result.getClock()); });
  return given;
}

core::Interval RemoteUnit::clock_shift(const core::Variable& clock) {
  core::Interval shift;
  call(
      "the shift of a clock",
      [&](wire::Request::Builder request) { request.setGetClockShift(clock.reference); },
      [&](wire::Result::Reader result) { shift = take_clock(result.getClock()).interval; });
  return shift;
}

// ---- Idle time ----

void RemoteUnit::enable_idle_skipping(Duration max_skip) {
  defer([&](wire::Request::Builder request) { request.setEnableIdleSkipping(max_skip.count()); });
}

void RemoteUnit::set_idle_tolerances(References outputs, std::span<const double> tolerances) {
  defer([&](wire::Request::Builder request) {
    auto to = request.initSetIdleTolerances();
    put_references(to.initOutputs(static_cast<unsigned>(outputs.size())), outputs);
    to.setTolerances(to_data(tolerances));
  });
}

Time RemoteUnit::idle_until() {
  Time until = Time::min();
  call(
      "its idle promise", [](wire::Request::Builder request) { request.setGetIdleUntil(); },
      [&](wire::Result::Reader result) { until = to_time(result.getTime()); });
  return until;
}

void RemoteUnit::get_derivatives(References outputs, std::span<double> derivatives) {
  call(
      "derivatives of outputs",
      [&](wire::Request::Builder request) {
        put_references(request.initGetDerivatives(static_cast<unsigned>(outputs.size())), outputs);
      },
      [&](wire::Result::Reader result) { take_doubles(result.getNumbers(), derivatives); });
}

// ---- Messages in words ----

std::string RemoteUnit::describe_message(core::ValueReference variable, const core::Binary& value) {
  std::string text;
  call(
      "the text of a message",
      [&](wire::Request::Builder request) {
        auto asked = request.initDescribeMessage();
        asked.setVariable(variable);
        asked.setValue(to_data(value.data(), value.size()));
      },
      [&](wire::Result::Reader result) { text = to_string(result.getText()); });
  return text;
}

}  // namespace stride::remote
