// The channel as an FMU: the variable table, and the way from the variables to the model.
#include "units/channel/unit.h"

#include <cstddef>
#include <string>
#include <vector>

#include <stride/unit.h>

#include "units/nfc_channel/model.h"

using nfc_channel::Channel;
using nfc_channel::TagParameters;

class NfcChannel : public channel::ModelUnit<Channel, nfc_channel::Parameters> {
 public:
  explicit NfcChannel(const stride::Setup& setup)
      : ModelUnit(channel::tag_names(setup, "nfc-channel")) {
    describe_channel("Near-field channel between a reader's antenna and tags: power and frames");
    list_reader_pose("centre of the reader's coil",
                     "normal of the reader's coil, of any length but zero");
    list_coil("reader_coil", p_.reader.coil);
    for (std::size_t i = 0; i < tags().size(); ++i) {
      const std::string whose = tags()[i].text();
      list_tag_pose(i, "centre of the " + whose + "'s coil",
                    "normal of the " + whose + "'s coil, of any length but zero");
      list_coil(tags()[i].coil(), p_.tags[i].coil);
    }
    list_carrier_power(
        "what the reader's transmitter can bring into its antenna, 0 while it is off");
    const Meanings meanings{
        "distance between the coils' centres",
        "coupling factor k",
        "magnetic field of the reader at the tag, mean over the tag's coil, effective value",
        "amplitude at the tag's antenna without its chip",
        "power that the tag's antenna can deliver at most",
        "Eb/N0",
        ", at bit_rate"};
    list_outputs(meanings);
    list_field_reaches();
    list_frames();
    for (TagParameters& tag : p_.tags) list_tag_parameters(tag);
    list_reader_parameters();
    state();
  }

  void update_outputs() override {
    ModelUnit::update_outputs();
    for (std::size_t i = 0; i < reaches_.size(); ++i) reaches_[i] = channel_.link(i).field_reach;
  }

 private:
  void list_field_reaches() {
    reaches_.resize(tags().size());
    for (std::size_t i = 0; i < reaches_.size(); ++i) {
      output(tags()[i].variable("field_reach"), reaches_[i])
          .unit("m")
          .min(0)
          .depends_on(inputs_of(i))
          .description("how far along its axis the reader's field is above 1.5 A/m, effective");
    }
  }

  void list_coil(const std::string& name, nfc_channel::Coil& coil) {
    list_positive(name + ".radius", coil.radius, "m", "radius of the turns");
    list_positive(name + ".turns", coil.turns, "", "number of turns");
    list_positive(name + ".wire_radius", coil.wire_radius, "m", "radius of the wire");
    list_positive(name + ".inductance", coil.inductance, "H",
                  "inductance; 0 takes it from the geometry");
    list_positive(name + ".quality_factor", coil.quality_factor, "",
                  "quality factor of the coil, damping resistors included");
  }

  void list_positive(const std::string& name, double& value, const std::string& unit,
                     const std::string& what) {
    parameter(name, value).unit(unit).min(0).description(what);
  }

  void list_noise(const std::string& name, nfc_channel::Noise& noise) {
    list_positive(name + ".noise_temperature", noise.temperature, "K",
                  "of the receiver's thermal noise");
    list_positive(name + ".interference", noise.interference, "W",
                  "power of other sources in the band of 106 kbit/s");
  }

  void list_tag_parameters(TagParameters& tag) {
    const std::string name = tag.name.prefix();
    list_positive(name + ".capacitance", tag.chip.capacitance, "F",
                  "parallel to the coil; 0 tunes it to the carrier");
    list_positive(name + ".voltage_limit", tag.chip.voltage_limit, "V",
                  "amplitude at which rectifier and limiter hold the antenna");
    list_positive(name + ".modulation_resistance", tag.chip.modulation_resistance, "Ohm",
                  "switched in parallel by the load modulator");
    list_positive(name + ".rectifier_drop", tag.rectifier_drop, "V",
                  "of the rectifier's two conducting diodes");
    list_positive(name + ".demodulator_voltage", tag.demodulator_voltage, "V",
                  "rectified; a tag with less receives nothing");
    list_noise(name, tag.noise);
  }

  void list_reader_parameters() {
    list_positive("reader.capacitance", p_.reader.capacitance, "F",
                  "in series with the coil; 0 tunes it to the carrier");
    list_noise("reader", p_.reader.noise);
    list_positive("reader.sensitivity", p_.reader.sensitivity, "W",
                  "a reader with less power receives nothing");
    list_positive("reader.capture_ratio", p_.reader.capture_ratio, "dB",
                  "a tag that is stronger by more masks another");
    parameter("seed", p_.seed).description("seed of the bit errors");
    parameter("bit_rate", p_.bit_rate)
        .description("for which signal-to-noise ratios and error rates are put out [kbit/s]");
  }

  std::vector<double> reaches_;  // for each tag [m]
};

STRIDE_UNIT(NfcChannel)
