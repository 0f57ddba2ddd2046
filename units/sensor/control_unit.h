// The control unit: a microcontroller that executes commands, clock cycle by clock cycle.
#ifndef STRIDE_UNITS_SENSOR_CONTROL_UNIT_H
#define STRIDE_UNITS_SENSOR_CONTROL_UNIT_H

#include <cstdint>
#include <systemc>

#include <stride/nfc/commands.h>
#include <stride/systemc/timer.h>
#include <stride/time.h>

#include "units/sensor/command_fifo.h"
#include "units/sensor/parameters.h"
#include "units/sensor/sample_log.h"
#include "units/sensor/transceiver.h"

namespace sensor {

/// boot -> stop <-> wake up -> decode -> execute or convert -> hand over -> decode ... stop.
///                  wake up -> convert -> log -> stop.
///
/// In stop mode it needs no clock; a command in the FIFO wakes it, and the timer when a sample is
/// due. Commands come first. When power fails it is reset at once: the commands, the LED's state,
/// the selection, the sampling period and the log are lost, and it boots when power is back.
class ControlUnit : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clock{"clock"};
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_in<bool> carrier{"carrier"};             ///< its loss deselects
  sc_core::sc_out<bool> clock_enable{"clock_enable"};  ///< set while it is awake
  sc_core::sc_out<double> current{"current"};          ///< its own [A]
  sc_core::sc_out<bool> led{"led"};
  sc_core::sc_out<double> led_current{"led_current"};  ///< [A]

  sc_core::sc_out<bool> adc_start{"adc_start"};
  sc_core::sc_in<bool> adc_busy{"adc_busy"};
  sc_core::sc_in<std::int32_t> adc_code{"adc_code"};

  sc_core::sc_port<TransmitInterface> transmitter{"transmitter"};

  /// The fifo has to outlive it.
  ControlUnit(sc_core::sc_module_name name, const SensorParameters& parameters, CommandFifo& fifo);

  /// In stop mode or without power, with nothing to do until the timer goes off.
  bool asleep() const { return (state_ == State::Stop || state_ == State::Off) && !sample_due_; }
  bool selected() const { return selected_ || always_selected_; }
  const SampleLog& log() const { return log_; }

 private:
  enum class State { Off, Boot, Stop, WakeUp, Decode, Execute, Start, Convert, HandOver };

  void run();
  void on_timer();
  void switch_on();
  void switch_off();
  void on_clock();
  void finish_state();
  void enter(State state, std::int32_t cycles);
  void stop();

  void fetch();
  void decode();
  void execute();
  void select();
  void set_sampling_period();
  void start_conversion();
  void begin_conversion();
  void finish_conversion();
  void answer(nfc::Status status, const nfc::Bytes& data = {});
  void hand_over();
  void set_led(bool on);
  double timer_current() const;

  nfc::Command command() const { return static_cast<nfc::Command>(command_.data.front()); }
  std::uint32_t identifier() const;
  nfc::Bytes log_data() const;

  ControlUnitParameters parameters_;
  AdcParameters adc_;
  bool always_selected_;
  CommandFifo& fifo_;

  State state_ = State::Off;
  std::int32_t remaining_cycles_ = 0;
  ReceivedCommand command_;
  nfc::Bytes answer_;
  bool selected_ = false;

  stride::systemc::Timer timer_{"timer"};
  sc_core::sc_event sample_event_{"sample_event"};
  stride::Duration sampling_period_{};  ///< zero: no samples
  bool sample_due_ = false;
  bool sampling_ = false;  ///< the conversion is for the log
  stride::Time sampled_at_;
  SampleLog log_;
};

}  // namespace sensor

#endif
