#include "units/sensor/control_unit.h"

#include "units/sensor/adc.h"

namespace sensor {
namespace {

using nfc::Command;
using nfc::Status;

template <class Unsigned>
nfc::Bytes most_significant_first(Unsigned value) {
  nfc::Bytes bytes(sizeof(Unsigned));
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * (sizeof(Unsigned) - 1 - i)));
  }
  return bytes;
}

/// The number of argument bytes of a command, -1 if there is no such command.
int argument_count(Command command) {
  switch (command) {
    case Command::kIdentify:
    case Command::kReadTemperature:
      return 0;
    case Command::kSetLed:
      return 1;
  }
  return -1;
}

}  // namespace

ControlUnit::ControlUnit(sc_core::sc_module_name name, const ControlUnitParameters& parameters,
                         const AdcParameters& adc, CommandFifo& fifo)
    : sc_module(name), parameters_(parameters), adc_(adc), fifo_(fifo) {
  SC_HAS_PROCESS(ControlUnit);
  SC_METHOD(run);
  sensitive << clock.pos() << powered << fifo_.written();
}

void ControlUnit::run() {
  if (!powered.read()) return switch_off();
  if (state_ == State::kOff) return switch_on();
  if (state_ == State::kStop) {
    if (!fifo_.empty()) enter(State::kWakeUp, parameters_.wake_up_cycles);
    return;
  }
  if (clock.posedge()) on_clock();
}

void ControlUnit::switch_on() { enter(State::kBoot, parameters_.boot_cycles); }

void ControlUnit::switch_off() {
  state_ = State::kOff;
  fifo_.clear();
  clock_enable.write(false);
  adc_start.write(false);
  current.write(0);
  set_led(false);
}

void ControlUnit::enter(State state, std::int32_t cycles) {
  state_ = state;
  remaining_cycles_ = cycles;
  clock_enable.write(true);
  current.write(parameters_.active_current);
}

void ControlUnit::stop() {
  state_ = State::kStop;
  clock_enable.write(false);
  current.write(parameters_.sleep_current);
}

void ControlUnit::on_clock() {
  if (--remaining_cycles_ <= 0) finish_state();
}

void ControlUnit::finish_state() {
  switch (state_) {
    case State::kBoot:
    case State::kWakeUp:
      return fetch();
    case State::kDecode:
      return decode();
    case State::kExecute:
      return execute();
    case State::kStart:
      return begin_conversion();
    case State::kConvert:
      return finish_conversion();
    case State::kHandOver:
      return hand_over();
    case State::kOff:
    case State::kStop:
      return;
  }
}

void ControlUnit::fetch() {
  if (fifo_.empty()) return stop();
  command_ = fifo_.pop();
  enter(State::kDecode, parameters_.decode_cycles);
}

void ControlUnit::decode() {
  if (command_.data.empty()) return answer(Status::kUnknownCommand);
  const auto command = static_cast<Command>(command_.data.front());
  const int expected = argument_count(command);
  if (expected < 0) return answer(Status::kUnknownCommand);
  if (command_.data.size() != static_cast<std::size_t>(expected) + 1) {
    return answer(Status::kBadArgument);
  }
  if (command == Command::kReadTemperature) {
    adc_start.write(true);
    return enter(State::kStart, 1);
  }
  enter(State::kExecute, parameters_.execute_cycles);
}

void ControlUnit::execute() {
  if (static_cast<Command>(command_.data.front()) == Command::kIdentify) {
    return answer(Status::kOk,
                  most_significant_first(static_cast<std::uint32_t>(parameters_.identifier)));
  }
  const std::uint8_t argument = command_.data[1];
  if (argument > 1) return answer(Status::kBadArgument);
  set_led(argument == 1);
  answer(Status::kOk);
}

void ControlUnit::begin_conversion() {
  if (!adc_busy.read()) return;
  adc_start.write(false);
  enter(State::kConvert, 1);
}

void ControlUnit::finish_conversion() {
  if (adc_busy.read()) return;
  const std::int16_t result = to_centidegrees(adc_, adc_code.read());
  answer(Status::kOk, most_significant_first(static_cast<std::uint16_t>(result)));
}

void ControlUnit::answer(Status status, const nfc::Bytes& data) {
  answer_ = {static_cast<std::uint8_t>(status)};
  answer_.insert(answer_.end(), data.begin(), data.end());
  enter(State::kHandOver, parameters_.cycles_per_byte * static_cast<std::int32_t>(answer_.size()));
}

void ControlUnit::hand_over() {
  if (!transmitter->can_send()) return;
  transmitter->send({command_.received, answer_});
  fetch();
}

void ControlUnit::set_led(bool on) {
  led.write(on);
  led_current.write(on ? parameters_.led_current : 0);
}

}  // namespace sensor
