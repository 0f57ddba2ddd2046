// The NFC smart sensor as a unit.
#include "units/systemc/unit.h"

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "units/nfc/frame.h"
#include "units/sensor/sensor.h"

namespace sensor {
namespace {

class SensorUnit : public stride::systemc::DeviceUnit<Sensor> {
 public:
  SensorUnit() : DeviceUnit("NFC smart sensor, a SystemC model") {
    list_inputs();
    list_outputs();
    visit_parameters(parameters_, [this](const ParameterInfo& info, auto& member) {
      auto row = parameter(info.name, member).description(info.description);
      using Member = std::decay_t<decltype(member)>;
      if constexpr (!std::is_same_v<Member, bool>) row.range(info.minimum, info.maximum);
      if constexpr (std::is_same_v<Member, double>) row.unit(info.unit);
    });
  }

 private:
  void list_inputs() {
    input("field_power", field_power_).unit("W").min(0).description("at the tag's antenna");
    input("adc.temperature", temperature_).unit("degC").description("at the ADC's sensor");
    input("receive.clock", receive_clock_).description("ticks when a frame comes");
    input("receive.frame", received_).clocked_by(receive_clock_).mime_type(kFrameType);
  }

  void list_outputs() {
    output("transmit.clock", transmit_clock_).description("ticks when an answer starts");
    output("transmit.frame", transmitted_).clocked_by(transmit_clock_).mime_type(kFrameType);
    output("capacitor.voltage", voltage_)
        .unit("V")
        .depends_on({})
        .derivative(voltage_rate_)
        .description("of the supercapacitor");
    output("capacitor.charge", charge_)
        .unit("C")
        .depends_on({})
        .derivative(charge_rate_)
        .description("in the supercapacitor");
    output("energy.intake", intake_)
        .unit("W")
        .depends_on({"field_power"})
        .description("taken by the charger");
    output("energy.load", load_)
        .unit("W")
        .depends_on({})
        .description("drawn from the capacitor by the loads");
    output("led", led_).discrete().depends_on({}).description("whether it is lit");
    output("mcu.powered", powered_).discrete().depends_on({}).description("not in brown-out");
    output("mcu.awake", awake_).discrete().depends_on({}).description("its clock runs");
    output("adc.value", code_).discrete().depends_on({}).description("code of the last conversion");
    list_counters();
  }

  void list_counters() {
    const auto counter = [this](const char* name, std::int32_t& member, const char* description) {
      output(name, member).discrete().depends_on({}).description(description);
    };
    counter("frames.received", counters_.received, "without error");
    counter("frames.rejected", counters_.rejected, "with a wrong parity, CRC, length or bit rate");
    counter("frames.sent", counters_.sent, "answers started");
    counter("frames.cut", counters_.cut, "answers cut off because power failed");
    counter("commands.lost", overflows_, "commands that found the FIFO full");
  }

  std::unique_ptr<Device> make_device(Log log) override {
    messages_.clear();
    auto device = std::make_unique<Device>(std::move(log), "sensor", parameters_);
    device->within([this](Sensor& sensor) {
      sensor.transceiver.on_transmit = [this](nfc::Frame frame) {
        frame.start = to_master(frame.start);
        messages_.push(nfc::encode(frame));
        sc_core::sc_pause();
      };
    });
    return device;
  }

  void write_inputs(Sensor& sensor) override {
    sensor.field_power.write(field_power_);
    sensor.temperature.write(temperature_);
  }

  void receive(Sensor& sensor) override {
    if (!receive_clock_.ticked()) return;
    nfc::Frame frame = nfc::decode(received_);
    frame.start = to_device(frame.start);
    sensor.transceiver.arrive(frame);
  }

  void read_outputs(Sensor& sensor) override {
    const PowerUnit& power = sensor.power_unit;
    voltage_ = power.voltage_now();
    charge_ = power.charge_now();
    charge_rate_ = power.charging_current_now();
    voltage_rate_ = charge_rate_ / parameters_.power.capacitance;
    intake_ = sensor.energy_intake.read();
    load_ = sensor.energy_load.read();
    led_ = sensor.led.read();
    powered_ = sensor.powered.read();
    awake_ = sensor.awake.read();
    code_ = sensor.adc_code.read();
    counters_ = sensor.transceiver.counters();
    overflows_ = sensor.fifo.overflows();
  }

  void publish() override { messages_.publish(); }

  static constexpr const char* kFrameType = "application/x-stride-nfc-frame";

  SensorParameters parameters_;

  double field_power_ = 0;
  double temperature_ = 20;
  stride::Binary received_;
  stride::Clock receive_clock_;

  stride::Binary transmitted_;
  stride::Clock transmit_clock_;
  stride::systemc::MessageOutput messages_{transmitted_, transmit_clock_};
  double voltage_ = 0;
  double voltage_rate_ = 0;
  double charge_ = 0;
  double charge_rate_ = 0;
  double intake_ = 0;
  double load_ = 0;
  bool led_ = false;
  bool powered_ = false;
  bool awake_ = false;
  std::int32_t code_ = 0;
  FrameCounters counters_;
  std::int32_t overflows_ = 0;
};

}  // namespace
}  // namespace sensor

STRIDE_UNIT(sensor::SensorUnit)
