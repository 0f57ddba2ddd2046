// The NFC smart sensor as a unit.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include <stride/nfc/frame.h>
#include <stride/nfc/in_words.h>
#include <stride/systemc/unit.h>

#include "units/sensor/sensor.h"

namespace sensor {
namespace {

class SensorUnit : public stride::systemc::DeviceUnit<Sensor> {
 public:
  SensorUnit() : DeviceUnit("NFC smart sensor, a SystemC model") {
    may_idle();
    list_inputs();
    list_outputs();
    visit_parameters(parameters_, [this](const ParameterInfo& info, auto& member) {
      auto row = parameter(info.name, member).description(info.description);
      using Member = std::decay_t<decltype(member)>;
      if constexpr (!std::is_same_v<Member, bool>) row.range(info.minimum, info.maximum);
      if constexpr (std::is_same_v<Member, double>) row.unit(info.unit);
    });
  }

  std::string describe_message(const stride::Variable& variable,
                               const stride::Binary& value) const override {
    const bool is_request = variable.data == &received_;
    return nfc::in_words(value, is_request ? nfc::Sender::Reader : nfc::Sender::Tag);
  }

 private:
  void list_inputs() {
    input("field_power", field_power_)
        .unit("W")
        .min(0)
        .description("what the tag's antenna can deliver at most");
    input("adc.temperature", temperature_)
        .unit("degC")
        .deadband(kAnyTemperature)
        .description("at the ADC's sensor");
    input("receive.clock", receive_clock_).description("ticks when a frame has come");
    input("receive.frame", received_).clocked_by(receive_clock_).mime_type(kFrameType);
  }

  void list_outputs() {
    output("transmit.clock", transmit_clock_)
        .description("ticks when an answer starts, or is cut off");
    output("transmit.frame", transmitted_).clocked_by(transmit_clock_).mime_type(kFrameType);
    quantity("capacitor.voltage", now_.terminal, rates_.terminal, "V", 1e-3,
             "at the supercapacitor's terminal");
    output("capacitor.charge", now_.charge)
        .unit("C")
        .depends_on({})
        .derivative(rates_.charge)
        .tolerance(1e-7)
        .description("in the supercapacitor");
    quantity("supply.voltage", now_.rail, rates_.rail, "V", 1e-3,
             "of the rail that feeds the regulator");
    quantity("energy.field", now_.drawn, rates_.drawn, "W", 1e-7,
             "taken from the antenna, by the limiter, too");
    quantity("energy.intake", now_.intake, rates_.intake, "W", 1e-7,
             "rectified, and not shunted by the limiter");
    quantity("energy.load", now_.load, rates_.load, "W", 1e-7,
             "drawn from the supply rail by regulator and loads");
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
    const auto entry = [this](const char* name, double& member, double& rate,
                              const char* description) {
      output(name, member)
          .unit("J")
          .depends_on({})
          .derivative(rate)
          .tolerance(1e-6)
          .description(description);
    };
    EnergyBooks& books = now_.books;
    EnergyBooks& powers = rates_.books;
    entry("balance.field", books.field, powers.field,
          "taken from the antenna since the start: all below");
    entry("balance.stored", now_.stored, rates_.stored, "gained by the supercapacitor");
    entry("balance.rectifier", books.rectifier, powers.rectifier, "lost in the rectifier");
    entry("balance.limiter", books.limiter, powers.limiter, "shunted by the limiter");
    entry("balance.charger", books.charger, powers.charger, "lost in the charger");
    entry("balance.series_resistance", books.series_resistance, powers.series_resistance,
          "lost in the supercapacitor's series resistance");
    entry("balance.leakage", books.leakage, powers.leakage, "leaked from the supercapacitor");
    entry("balance.regulator", books.regulator, powers.regulator, "lost in the regulator");
    const auto part = [&](const char* name, Part index, const char* description) {
      entry(name, books.parts[index], powers.parts[index], description);
    };
    part("balance.control_unit", kControlUnit, "used by the control unit");
    part("balance.transceiver", kTransceiver, "used by the transceiver");
    part("balance.adc", kAdc, "used by the ADC");
    part("balance.led", kLed, "used by the LED");
  }

  void list_counters() {
    indicator("frames.received", counters_.received, "without error");
    indicator("frames.rejected", counters_.rejected,
              "with a wrong parity, CRC, length or bit rate");
    indicator("frames.sent", counters_.sent, "answers started");
    indicator("frames.cut", counters_.cut, "answers cut off because power or carrier failed");
    indicator("frames.dropped", counters_.dropped,
              "answers not started because power or carrier is missing");
    indicator("commands.lost", overflows_, "commands that found the FIFO full");
  }

  // A step of the field's power is a step of the supply, and may be a brown-out at that instant.
  void quantity(const char* name, double& member, const double& rate, const char* unit,
                double tolerance, const char* description) {
    output(name, member)
        .unit(unit)
        .depends_on({"field_power"})
        .derivative(rate)
        .tolerance(tolerance)
        .description(description);
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
    now_ = sensor.power_unit.readings_now();
    rates_ = sensor.power_unit.rates_now();
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

  void list_signals(const Sensor& sensor, stride::systemc::SignalList& signals) const override {
    visit_signals(sensor, [&](const auto& signal) { signals.add(signal); });
  }

  bool idle(const Sensor& sensor) const override { return sensor.idle(); }
  stride::Duration clock_period(const Sensor& sensor) const override {
    const GatedClock& clock = sensor.gated_clock;
    return clock.gating() ? stride::Duration{} : clock.period();
  }
  stride::Duration tangents_hold_for(const Sensor& sensor) const override {
    stride::Duration shortest = stride::Duration::max();
    const PowerReadings curvatures = sensor.power_unit.curvatures_now();
    visit_pairs(now_, curvatures, [&](const double& reading, double curvature) {
      const double tolerance = tolerance_of(reading);
      shortest = std::min(shortest, stride::tangent_holds_for(tolerance, curvature));
    });
    return shortest;
  }

  static constexpr const char* kFrameType = "application/x-stride-nfc-frame";
  /// It is looked at where a conversion begins only, which is never while the sensor is idle.
  static constexpr double kAnyTemperature = 1e6;

  SensorParameters parameters_;

  double field_power_ = 0;
  double temperature_ = 20;
  stride::Binary received_;
  stride::Clock receive_clock_;

  stride::Binary transmitted_;
  stride::Clock transmit_clock_;
  stride::systemc::MessageOutput messages_{transmitted_, transmit_clock_};
  PowerReadings now_;
  PowerReadings rates_;
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
