// The channel as an FMU: the variable table, and the way from the variables to the model.
#include <optional>
#include <string>
#include <vector>

#include <stride/unit.h>

#include "units/nfc_channel/model.h"

namespace {

using nfc_channel::Channel;

constexpr double kNominalBitRate = nfc::kCarrierFrequency / 128.0;  // [bit/s], called 106 kbit/s

}  // namespace

class NfcChannel : public stride::Unit {
 public:
  NfcChannel() {
    describe("Near-field channel between a reader's antenna and a tag's: power and frames");
    list_coil("reader_coil", "reader", p_.reader_coil, reader_coil_);
    list_coil("tag_coil", "tag", p_.tag_coil, tag_coil_);
    const std::vector<std::string> poses = names_of_inputs();
    input("carrier_power", carrier_power_)
        .unit("W")
        .min(0)
        .discrete()
        .description(
            "power that the reader's transmitter brings into its antenna, 0 while it is off");
    const std::vector<std::string> link = names_of_inputs();
    list_outputs(poses, link);
    list_port("reader", from_reader_, "tag", to_tag_);
    list_port("tag", from_tag_, "reader", to_reader_);
    list_parameters();
    state(channel_.state());
  }

  void initialize(stride::Time) override { channel_ = Channel(p_); }
  void step(stride::Step&) override { update_outputs(); }

  void event(stride::Event&) override {
    update_outputs();
    pass(from_reader_, to_tag_, &Channel::to_tag);
    pass(from_tag_, to_reader_, &Channel::to_reader);
  }

  void update_outputs() override {
    channel_.move(reader_coil_, tag_coil_, carrier_power_);
    link_ = channel_.link();
    const double down = channel_.snr_down(kNominalBitRate);
    const double up = channel_.snr_up(kNominalBitRate);
    snr_down_ = nfc_channel::decibels(down);
    snr_up_ = nfc_channel::decibels(up);
    bit_error_rate_down_ = nfc_channel::bit_error_probability(down);
    bit_error_rate_up_ = nfc_channel::bit_error_probability(up);
  }

  // a state may come from an instance with other parameters
  void load_state(stride::StateReader&) override {
    const Channel::State state = channel_.state();
    channel_ = Channel(p_);
    channel_.state() = state;
  }

 private:
  struct Port {
    stride::Clock clock;
    stride::Binary frame;
  };

  void pass(const Port& from, Port& to,
            std::optional<nfc::Frame> (Channel::*heard)(const nfc::Frame&)) {
    if (!from.clock.ticked()) return;
    const auto frame = (channel_.*heard)(nfc::decode(from.frame));
    if (!frame) return;
    to.frame = nfc::encode(*frame);
    to.clock.tick();
  }

  void list_coil(const std::string& name, const std::string& whose, nfc_channel::Coil& coil,
                 nfc_channel::Pose& pose) {
    for (int i = 0; i < 3; ++i) {
      input(name + ".position." + "xyz"[i], pose.position[i])
          .unit("m")
          .description("centre of the " + whose + "'s coil");
    }
    for (int i = 0; i < 3; ++i) {
      input(name + ".axis." + "xyz"[i], pose.axis[i])
          .description("normal of the " + whose + "'s coil, of any length but zero");
    }
    parameter(name + ".radius", coil.radius).unit("m").min(0).description("radius of the turns");
    parameter(name + ".turns", coil.turns).min(0).description("number of turns");
    parameter(name + ".wire_radius", coil.wire_radius)
        .unit("m")
        .min(0)
        .description("radius of the wire");
    parameter(name + ".inductance", coil.inductance)
        .unit("H")
        .min(0)
        .description("inductance; 0 takes it from the geometry");
    parameter(name + ".quality_factor", coil.quality_factor)
        .min(0)
        .description("quality factor of the loaded resonant circuit");
  }

  std::vector<std::string> names_of_inputs() const {
    std::vector<std::string> names;
    for (const auto& row : variables()) {
      if (row.causality == stride::Causality::Input) names.push_back(row.name);
    }
    return names;
  }

  void list_outputs(const std::vector<std::string>& poses, const std::vector<std::string>& link) {
    output("distance", link_.distance)
        .unit("m")
        .depends_on(poses)
        .description("distance between the coils' centres");
    output("coupling", link_.coupling)
        .range(0, 1)
        .depends_on(poses)
        .description("coupling factor k");
    output("tag_power", link_.tag_power)
        .unit("W")
        .min(0)
        .depends_on(link)
        .description("power that the tag's antenna delivers");
    output("snr.down", snr_down_)
        .unit("dB")
        .range(-200, 200)
        .depends_on(link)
        .description("signal-to-noise ratio at the tag, 106 kbit/s");
    output("snr.up", snr_up_)
        .unit("dB")
        .range(-200, 200)
        .depends_on(link)
        .description("signal-to-noise ratio at the reader, 106 kbit/s");
    output("bit_error_rate.down", bit_error_rate_down_)
        .range(0, 0.5)
        .depends_on(link)
        .description("probability of a wrong bit at the tag, 106 kbit/s");
    output("bit_error_rate.up", bit_error_rate_up_)
        .range(0, 0.5)
        .depends_on(link)
        .description("probability of a wrong bit at the reader, 106 kbit/s");
  }

  void list_port(const std::string& sender, Port& from, const std::string& receiver, Port& to) {
    const std::string in = "from_" + sender;
    const std::string out = "to_" + receiver;
    input(in + ".clock", from.clock).description("ticks when a frame of the " + sender + " begins");
    input(in + ".frame", from.frame)
        .clocked_by(from.clock)
        .description("the frame as the " + sender + " sends it");
    output(out + ".clock", to.clock)
        .description("ticks when the " + receiver + " begins to hear a frame");
    output(out + ".frame", to.frame)
        .clocked_by(to.clock)
        .depends_on({})
        .description("the frame as the " + receiver + " hears it, with bit errors");
  }

  void list_parameters() {
    list_receiver("tag", p_.tag_noise);
    parameter("tag.power_threshold", p_.tag_power_threshold)
        .unit("W")
        .min(0)
        .description("a tag with less power does not hear");
    parameter("tag.power_limit", p_.tag_power_limit)
        .unit("W")
        .min(0)
        .description("what exceeds it goes into the tag's voltage limiter");
    parameter("tag.load_match", p_.load_match)
        .range(0, 1)
        .description("share of the optimal load's power that the tag takes");
    parameter("tag.modulation_depth", p_.modulation_depth)
        .range(0, 1)
        .description("amplitude of the load modulation");
    list_receiver("reader", p_.reader_noise);
    parameter("reader.sensitivity", p_.reader_sensitivity)
        .unit("W")
        .min(0)
        .description("a reader that receives less power does not hear");
    parameter("seed", p_.seed).description("seed of the bit errors");
  }

  void list_receiver(const std::string& name, nfc_channel::Noise& noise) {
    parameter(name + ".noise_temperature", noise.temperature)
        .unit("K")
        .min(0)
        .description("of the receiver's thermal noise");
    parameter(name + ".interference", noise.interference)
        .unit("W")
        .min(0)
        .description("power of other sources in the receiver's band");
  }

  nfc_channel::Parameters p_;
  nfc_channel::Pose reader_coil_;
  nfc_channel::Pose tag_coil_;
  double carrier_power_ = 0.0;
  Port from_reader_;
  Port to_tag_;
  Port from_tag_;
  Port to_reader_;

  Channel channel_;
  nfc_channel::Link link_;  // what the outputs show
  double snr_down_ = 0.0;
  double snr_up_ = 0.0;
  double bit_error_rate_down_ = 0.0;
  double bit_error_rate_up_ = 0.0;
};

STRIDE_UNIT(NfcChannel)
