// The sensor of units/sensor as a program of its own: nothing here is a unit, and no FMI.
#include "units/sensor/sensor.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <stride/nfc/frame.h>
#include <stride/process/program.h>
#include <stride/systemc/device.h>
#include <stride/systemc/time.h>
#include <stride/systemc/trace.h>

namespace {

using sensor::Sensor;
using stride::Duration;
using stride::Time;
using stride::process::Binary;

class SensorProgram : public stride::process::Program {
 public:
  SensorProgram() {
    visit_parameters(parameters_,
                     [this](const auto& info, auto& member) { parameter(info.name, member); });
    input("field_power", field_power_);
    input("adc.temperature", temperature_);
    message_input<Binary>("receive.frame", [this](const Binary& message) { receive(message); });
    list_outputs();
  }

 private:
  using Device = stride::systemc::Device<Sensor>;

  void list_outputs() {
    output("capacitor.voltage", power_.terminal);
    output("capacitor.charge", power_.charge);
    output("supply.voltage", power_.rail);
    output("energy.field", power_.drawn);
    output("energy.intake", power_.intake);
    output("energy.load", power_.load);
    output("led", led_);
    output("mcu.powered", powered_);
    output("mcu.awake", awake_);
    output("mcu.selected", selected_);
    output("adc.value", code_);
    output("log.samples", samples_);
    output("frames.received", counters_.received);
    output("frames.rejected", counters_.rejected);
    output("frames.sent", counters_.sent);
    output("frames.cut", counters_.cut);
    output("frames.dropped", counters_.dropped);
    output("commands.lost", overflows_);
  }

  void trace(const std::string& file, const std::string& signals) override {
    trace_options_ = {file, signals};
  }

  void start() override {
    start_ = now();
    device_ = std::make_unique<Device>(
        [this](sc_core::sc_severity severity, const std::string& text) {
          using stride::process::LogLevel;
          log(severity == sc_core::SC_INFO ? LogLevel::Info : LogLevel::Warning, text);
        },
        "sensor", parameters_);
    device_->within([this](Sensor& sensor) {
      sensor.transceiver.on_transmit = [this](nfc::Frame frame) { transmit(std::move(frame)); };
    });
    if (!trace_options_.file.empty()) open_trace();
    advance(start_, false);
  }

  Time step(Time to, bool may_stop) override {
    has_sent_ = false;
    return advance(to, may_stop);
  }

  void finish() override {
    trace_.reset();
    device_.reset();
  }

  /// What the inputs cause where the step begins may end it there already.
  Time advance(Time to, bool may_stop) {
    device_->within([this](Sensor& sensor) {
      sensor.field_power.write(field_power_);
      sensor.temperature.write(temperature_);
    });
    Time reached = device_->advance(device_->now());
    if (!may_stop || !has_sent_) reached = device_->advance(to_device(to), may_stop);
    device_->within([this](Sensor& sensor) { read_outputs(sensor); });
    return to_master(reached);
  }

  void receive(const Binary& message) {
    device_->within([&](Sensor& sensor) {
      nfc::Frame frame = nfc::decode(message);
      frame.start = to_device(frame.start);
      sensor.transceiver.arrive(frame);
    });
  }

  void transmit(nfc::Frame frame) {
    frame.start = to_master(frame.start);
    send("transmit.frame", to_master(stride::systemc::current_time()), nfc::encode(frame));
    has_sent_ = true;
    sc_core::sc_pause();
  }

  void read_outputs(const Sensor& sensor) {
    power_ = sensor.power_unit.readings_now();
    led_ = sensor.led.read();
    powered_ = sensor.powered.read();
    awake_ = sensor.awake.read();
    selected_ = powered_ && sensor.control_unit.selected();
    code_ = sensor.adc_code.read();
    samples_ = static_cast<std::int32_t>(sensor.control_unit.log().size());
    counters_ = sensor.transceiver.counters();
    overflows_ = sensor.fifo.overflows();
  }

  void open_trace() {
    stride::systemc::SignalList signals;
    device_->within([&](const Sensor& sensor) {
      visit_signals(sensor, [&](const auto& signal) { signals.add(signal); });
    });
    trace_.emplace(device_->kernel(), trace_options_, signals);
  }

  Time to_device(Time time) const { return Time(time - start_); }
  Time to_master(Time time) const { return start_ + time.time_since_epoch(); }

  sensor::SensorParameters parameters_;
  double field_power_ = 0;
  double temperature_ = 20;
  sensor::PowerReadings power_;
  bool led_ = false;
  bool powered_ = false;
  bool awake_ = false;
  bool selected_ = false;
  std::int32_t code_ = 0;
  std::int32_t samples_ = 0;
  sensor::FrameCounters counters_;
  std::int32_t overflows_ = 0;

  Time start_;
  bool has_sent_ = false;  ///< in this step
  stride::systemc::TraceOptions trace_options_;
  std::unique_ptr<Device> device_;
  std::optional<stride::systemc::Trace> trace_;  // closed before the device is destroyed
};

}  // namespace

int main() { return SensorProgram().run(); }
