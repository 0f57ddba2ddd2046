#include "units/sensor/control_unit.h"

#include <algorithm>
#include <chrono>

#include <stride/nfc/numbers.h>
#include <stride/systemc/time.h>

#include "units/sensor/adc.h"

namespace sensor {
namespace {

using nfc::Command;
using nfc::most_significant_first;
using nfc::Status;
using stride::systemc::current_time;

constexpr stride::Duration kSecond = std::chrono::seconds(1);

/// By those that are not selected, too.
bool answered_by_all(Command command) {
  return command == Command::Identify || command == Command::Select;
}

/// The number that the arguments of a command are.
std::uint32_t argument(const nfc::Bytes& command) {
  return nfc::number_in(command, 1, command.size());
}

void append(nfc::Bytes& bytes, const nfc::Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

std::uint16_t age_in_seconds(stride::Time taken) {
  const std::int64_t age = (current_time() - taken) / kSecond;
  return static_cast<std::uint16_t>(std::min<std::int64_t>(age, nfc::kOldestLogAge));
}

}  // namespace

ControlUnit::ControlUnit(sc_core::sc_module_name name, const SensorParameters& parameters,
                         CommandFifo& fifo)
    : sc_module(name),
      parameters_(parameters.control_unit),
      adc_(parameters.adc),
      always_selected_(parameters.transceiver.always_selected),
      fifo_(fifo) {
  SC_HAS_PROCESS(ControlUnit);
  SC_METHOD(run);
  sensitive << clock.pos() << powered << carrier << fifo_.written() << sample_event_;
  SC_METHOD(on_timer);
  sensitive << timer_.event();
  dont_initialize();
}

void ControlUnit::run() {
  if (!powered.read()) return switch_off();
  if (!carrier.read()) selected_ = false;
  if (state_ == State::Off) return switch_on();
  if (state_ == State::Stop) {
    if (!fifo_.empty() || sample_due_) enter(State::WakeUp, parameters_.wake_up_cycles);
    return;
  }
  if (clock.posedge()) on_clock();
}

void ControlUnit::on_timer() {
  timer_.set_after(sampling_period_);
  sample_due_ = true;
  sample_event_.notify(sc_core::SC_ZERO_TIME);
}

void ControlUnit::switch_on() { enter(State::Boot, parameters_.boot_cycles); }

void ControlUnit::switch_off() {
  state_ = State::Off;
  fifo_.clear();
  log_.clear();
  timer_.cancel();
  sampling_period_ = {};
  sample_due_ = false;
  selected_ = false;
  clock_enable.write(false);
  adc_start.write(false);
  current.write(0);
  set_led(false);
}

void ControlUnit::enter(State state, std::int32_t cycles) {
  state_ = state;
  remaining_cycles_ = cycles;
  clock_enable.write(true);
  current.write(parameters_.active_current + timer_current());
}

void ControlUnit::stop() {
  state_ = State::Stop;
  clock_enable.write(false);
  current.write(parameters_.sleep_current + timer_current());
}

double ControlUnit::timer_current() const {
  return sampling_period_ > stride::Duration{} ? parameters_.timer_current : 0;
}

void ControlUnit::on_clock() {
  if (--remaining_cycles_ <= 0) finish_state();
}

void ControlUnit::finish_state() {
  switch (state_) {
    case State::Boot:
    case State::WakeUp:
      return fetch();
    case State::Decode:
      return decode();
    case State::Execute:
      return execute();
    case State::Start:
      return begin_conversion();
    case State::Convert:
      return finish_conversion();
    case State::HandOver:
      return hand_over();
    case State::Off:
    case State::Stop:
      return;
  }
}

void ControlUnit::fetch() {
  if (!fifo_.empty()) {
    command_ = fifo_.pop();
    return enter(State::Decode, parameters_.decode_cycles);
  }
  if (!sample_due_) return stop();
  sample_due_ = false;
  sampling_ = true;
  start_conversion();
}

void ControlUnit::decode() {
  const int expected = command_.data.empty() ? -1 : nfc::argument_bytes(command());
  const bool well_formed =
      expected >= 0 && command_.data.size() == static_cast<std::size_t>(expected) + 1;
  if (!selected() && !(well_formed && answered_by_all(command()))) return fetch();
  if (expected < 0) return answer(Status::UnknownCommand);
  if (!well_formed) return answer(Status::BadArgument);
  if (command() != Command::ReadTemperature) {
    return enter(State::Execute, parameters_.execute_cycles);
  }
  sampling_ = false;
  start_conversion();
}

void ControlUnit::execute() {
  switch (command()) {
    case Command::Identify:
      return answer(Status::Ok, most_significant_first(identifier()));
    case Command::Select:
      return select();
    case Command::SetLed:
      if (argument(command_.data) > 1) return answer(Status::BadArgument);
      set_led(argument(command_.data) == 1);
      return answer(Status::Ok);
    case Command::SetSamplingPeriod:
      set_sampling_period();
      return answer(Status::Ok);
    case Command::ReadLog:
      return answer(Status::Ok, log_data());
    case Command::Sleep:
      set_led(false);
      selected_ = false;
      return answer(Status::Ok);
    case Command::ReadTemperature:
      return;  // has been converted instead
  }
}

std::uint32_t ControlUnit::identifier() const {
  return static_cast<std::uint32_t>(parameters_.identifier);
}

void ControlUnit::select() {
  selected_ = argument(command_.data) == identifier() && carrier.read();
  if (!selected_) return fetch();
  answer(Status::Ok);
}

void ControlUnit::set_sampling_period() {
  timer_.cancel();
  sample_due_ = false;
  sampling_period_ = argument(command_.data) * kSecond;
  if (sampling_period_ > stride::Duration{}) timer_.set_after(sampling_period_);
}

nfc::Bytes ControlUnit::log_data() const {
  nfc::Bytes data;
  for (std::size_t i = 0; i < log_.size(); ++i) {
    append(data, most_significant_first(age_in_seconds(log_[i].taken)));
    append(data, most_significant_first(static_cast<std::uint16_t>(log_[i].centidegrees)));
  }
  return data;
}

void ControlUnit::start_conversion() {
  adc_start.write(true);
  enter(State::Start, 1);
}

void ControlUnit::begin_conversion() {
  if (!adc_busy.read()) return;
  adc_start.write(false);
  sampled_at_ = current_time();
  enter(State::Convert, 1);
}

void ControlUnit::finish_conversion() {
  if (adc_busy.read()) return;
  const std::int16_t result = to_centidegrees(adc_, adc_code.read());
  if (!sampling_) {
    return answer(Status::Ok, most_significant_first(static_cast<std::uint16_t>(result)));
  }
  log_.add({sampled_at_, result});
  fetch();
}

void ControlUnit::answer(Status status, const nfc::Bytes& data) {
  answer_ = {static_cast<std::uint8_t>(status)};
  append(answer_, data);
  enter(State::HandOver, parameters_.cycles_per_byte * static_cast<std::int32_t>(answer_.size()));
}

void ControlUnit::hand_over() {
  if (!transmitter->can_send()) return;
  transmitter->send({command_.first_answer, answer_});
  fetch();
}

void ControlUnit::set_led(bool on) {
  led.write(on);
  led_current.write(on ? parameters_.led_current : 0);
}

}  // namespace sensor
