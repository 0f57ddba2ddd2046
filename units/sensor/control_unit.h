// The control unit: a microcontroller that executes commands, clock cycle by clock cycle.
#ifndef STRIDE_UNITS_SENSOR_CONTROL_UNIT_H
#define STRIDE_UNITS_SENSOR_CONTROL_UNIT_H

#include <cstdint>
#include <systemc>

#include "units/nfc/commands.h"
#include "units/sensor/command_fifo.h"
#include "units/sensor/parameters.h"
#include "units/sensor/transceiver.h"

namespace sensor {

/// boot -> stop <-> wake up -> decode -> execute or convert -> hand over -> decode ... stop.
///
/// In stop mode it needs no clock; a command in the FIFO wakes it. When power fails it is reset at
/// once, the commands and the LED's state are lost, and it boots when power is back.
class ControlUnit : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clock{"clock"};
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_out<bool> clock_enable{"clock_enable"};  ///< set while it is awake
  sc_core::sc_out<double> current{"current"};          ///< its own [A]
  sc_core::sc_out<bool> led{"led"};
  sc_core::sc_out<double> led_current{"led_current"};  ///< [A]

  sc_core::sc_out<bool> adc_start{"adc_start"};
  sc_core::sc_in<bool> adc_busy{"adc_busy"};
  sc_core::sc_in<std::int32_t> adc_code{"adc_code"};

  sc_core::sc_port<TransmitInterface> transmitter{"transmitter"};

  ControlUnit(sc_core::sc_module_name name, const ControlUnitParameters& parameters,
              const AdcParameters& adc, CommandFifo& fifo);

 private:
  enum class State { kOff, kBoot, kStop, kWakeUp, kDecode, kExecute, kStart, kConvert, kHandOver };

  void run();
  void switch_on();
  void switch_off();
  void on_clock();
  void finish_state();
  void enter(State state, std::int32_t cycles);

  void fetch();
  void stop();
  void decode();
  void execute();
  void begin_conversion();
  void finish_conversion();
  void answer(nfc::Status status, const nfc::Bytes& data = {});
  void hand_over();
  void set_led(bool on);

  ControlUnitParameters parameters_;
  AdcParameters adc_;
  CommandFifo& fifo_;

  State state_ = State::kOff;
  std::int32_t remaining_cycles_ = 0;
  ReceivedCommand command_;
  nfc::Bytes answer_;
};

}  // namespace sensor

#endif
