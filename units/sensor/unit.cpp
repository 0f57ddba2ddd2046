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
    input("receive.clock", receive_clock_).description("ticks when a frame has come");
    input("receive.frame", received_).clocked_by(receive_clock_).mime_type(kFrameType);
  }

  void list_outputs() {
    output("transmit.clock", transmit_clock_)
        .description("ticks when an answer starts, or is cut off");
    output("transmit.frame", transmitted_).clocked_by(transmit_clock_).mime_type(kFrameType);
    quantity("capacitor.voltage", voltage_, "V", "at the supercapacitor's terminal")
        .derivative(voltage_rate_);
    output("capacitor.charge", charge_)
        .unit("C")
        .depends_on({})
        .derivative(charge_rate_)
        .description("in the supercapacitor");
    quantity("supply.voltage", rail_, "V", "of the rail that feeds the regulator")
        .derivative(rail_rate_);
    quantity("energy.intake", intake_, "W", "rectified, and not shunted by the limiter");
    quantity("energy.load", load_, "W", "drawn from the supply rail by regulator and loads");
    indicator("led", led_, "whether it is lit");
    indicator("mcu.powered", powered_, "not in brown-out");
    indicator("mcu.awake", awake_, "its clock runs");
    indicator("mcu.selected", selected_, "answers to all commands");
    indicator("adc.value", code_, "code of the last conversion");
    indicator("log.samples", samples_, "samples in the log");
    list_balance();
    list_counters();
  }

  void list_balance() {
    const auto entry = [this](const char* name, double& member, const char* description) {
      output(name, member).unit("J").depends_on({}).description(description);
    };
    entry("balance.field", books_.field, "taken from the antenna since the start: all below");
    entry("balance.stored", stored_, "gained by the supercapacitor");
    entry("balance.rectifier", books_.rectifier, "lost in the rectifier");
    entry("balance.limiter", books_.limiter, "shunted by the limiter");
    entry("balance.charger", books_.charger, "lost in the charger");
    entry("balance.series_resistance", books_.series_resistance,
          "lost in the supercapacitor's series resistance");
    entry("balance.leakage", books_.leakage, "leaked from the supercapacitor");
    entry("balance.regulator", books_.regulator, "lost in the regulator");
    entry("balance.control_unit", books_.parts[kControlUnit], "used by the control unit");
    entry("balance.transceiver", books_.parts[kTransceiver], "used by the transceiver");
    entry("balance.adc", books_.parts[kAdc], "used by the ADC");
    entry("balance.led", books_.parts[kLed], "used by the LED");
  }

  void list_counters() {
    indicator("frames.received", counters_.received, "without error");
    indicator("frames.rejected", counters_.rejected,
              "with a wrong parity, CRC, length or bit rate");
    indicator("frames.sent", counters_.sent, "answers started");
    indicator("frames.cut", counters_.cut, "answers cut off because power or carrier failed");
    indicator("frames.dropped", counters_.dropped,
              "answers not started for want of power or carrier");
    indicator("commands.lost", overflows_, "commands that found the FIFO full");
  }

  // A step of the field's power is a step of the supply, and may be a brown-out at that instant.
  stride::VariableBuilder quantity(const char* name, double& member, const char* unit,
                                   const char* description) {
    return output(name, member).unit(unit).depends_on({"field_power"}).description(description);
  }
  template <class T>
  void indicator(const char* name, T& member, const char* description) {
    output(name, member).discrete().depends_on({"field_power"}).description(description);
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
    voltage_ = power.terminal_voltage_now();
    voltage_rate_ = power.terminal_rate_now();
    charge_ = power.charge_now();
    charge_rate_ = power.charge_rate_now();
    rail_ = power.rail_voltage_now();
    rail_rate_ = power.rail_rate_now();
    intake_ = power.intake_now();
    load_ = power.load_now();
    books_ = power.books_now();
    stored_ = power.stored_now();
    led_ = sensor.led.read();
    powered_ = sensor.powered.read();
    awake_ = sensor.awake.read();
    selected_ = powered_ && sensor.control_unit.selected();
    code_ = sensor.adc_code.read();
    samples_ = static_cast<std::int32_t>(sensor.control_unit.log().size());
    counters_ = sensor.transceiver.counters();
    overflows_ = sensor.fifo.overflows();
  }

  void publish() override { messages_.publish(); }
  bool has_message() const override { return !messages_.empty(); }

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
  double rail_ = 0;
  double rail_rate_ = 0;
  double intake_ = 0;
  double load_ = 0;
  EnergyBooks books_;
  double stored_ = 0;
  bool led_ = false;
  bool powered_ = false;
  bool awake_ = false;
  bool selected_ = false;
  std::int32_t code_ = 0;
  std::int32_t samples_ = 0;
  FrameCounters counters_;
  std::int32_t overflows_ = 0;
};

}  // namespace
}  // namespace sensor

STRIDE_UNIT(sensor::SensorUnit)
