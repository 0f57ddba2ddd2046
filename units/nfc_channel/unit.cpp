// The channel as an FMU: the variable table, and the way from the variables to the model.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <stride/unit.h>

#include "units/nfc_channel/model.h"
#include "units/nfc_channel/tag_list.h"

namespace {

using nfc_channel::Channel;
using nfc_channel::Observation;
using nfc_channel::Pose;
using nfc_channel::Reception;
using nfc_channel::TagParameters;

nfc_channel::Parameters parameters_for(const std::filesystem::path& resources) {
  nfc_channel::Parameters parameters;
  const std::filesystem::path file = resources / "channel.xml";
  if (resources.empty() || !std::filesystem::exists(file)) return parameters;
  const auto names = nfc_channel::read_tag_list(file.string());
  parameters.tags.resize(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) parameters.tags[i].name = names[i];
  return parameters;
}

/// A clock and the frame that comes with its tick.
struct Port {
  stride::Clock clock;
  stride::Binary frame;

  void send(const nfc::Frame& heard) {
    frame = nfc::encode(heard);
    clock.tick();
  }
};

/// The variables of one tag.
struct Tag {
  Port from, to;
  nfc_channel::Link link;
  double snr_down = 0.0;  // [dB]
  double snr_up = 0.0;
};

void save(stride::StateWriter& writer, const std::vector<Reception>& receptions) {
  writer.write(receptions.size());
  for (const Reception& r : receptions) {
    writer.write(r.sent.start), writer.write(r.sent.bit_rate), writer.write(r.sent.bits);
    writer.write(r.tag), writer.write(r.number), writer.write(r.end), writer.write(r.heard);
    writer.write(r.lost), writer.write(r.deaf), writer.write(r.strongest);
    writer.write(r.next_observation);
  }
}

void save(stride::StateWriter& writer, const std::vector<Observation>& observed) {
  writer.write(observed.size());
  for (const Observation& o : observed) {
    writer.write(o.time), writer.write(o.carrier_power), writer.write(o.signals);
  }
}

void load(stride::StateReader& reader, std::vector<Observation>& observed) {
  std::size_t count = 0;
  reader.read(count);
  observed.clear();
  for (; count > 0; --count) {
    Observation& o = observed.emplace_back();
    reader.read(o.time), reader.read(o.carrier_power), reader.read(o.signals);
  }
}

void load(stride::StateReader& reader, std::vector<Reception>& receptions) {
  std::size_t count = 0;
  reader.read(count);
  receptions.clear();
  for (; count > 0; --count) {
    Reception& r = receptions.emplace_back();
    reader.read(r.sent.start), reader.read(r.sent.bit_rate), reader.read(r.sent.bits);
    reader.read(r.tag), reader.read(r.number), reader.read(r.end), reader.read(r.heard);
    reader.read(r.lost), reader.read(r.deaf), reader.read(r.strongest);
    reader.read(r.next_observation);
  }
}

}  // namespace

class NfcChannel : public stride::Unit {
 public:
  explicit NfcChannel(const stride::Setup& setup)
      : p_(parameters_for(setup.resources)), channel_(p_) {
    auto& info =
        describe("Near-field channel between a reader's antenna and tags: power and frames");
    info.promises_idle = true;
    info.split_invariant = true;
    tags_.resize(p_.tags.size());
    tag_coils_.resize(p_.tags.size());
    list_coil("reader_coil", "reader", p_.reader.coil, reader_coil_);
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const TagParameters& tag = p_.tags[i];
      list_coil(tag.coil_name(), tag.name.empty() ? "tag" : "tag " + tag.name, p_.tags[i].coil,
                tag_coils_[i]);
    }
    input("carrier_power", carrier_power_)
        .unit("W")
        .min(0)
        .discrete()
        .description("what the reader's transmitter can bring into its antenna, 0 while it is off");
    for (std::size_t i = 0; i < tags_.size(); ++i) list_outputs(p_.tags[i], tags_[i]);
    list_input("from_reader", from_reader_, "the reader");
    for (std::size_t i = 0; i < tags_.size(); ++i) list_ports(p_.tags[i], tags_[i]);
    list_output("to_reader", to_reader_, "the reader");
    for (TagParameters& tag : p_.tags) list_tag_parameters(tag);
    list_reader_parameters();
    state();
  }

  void initialize(stride::Time) override {
    channel_ = Channel(p_);
    shown_.reset();
  }

  void step(stride::Step& step) override {
    update_outputs();
    channel_.observe(step.from());
    const auto end = channel_.next_end();
    if (end && *end <= step.to()) step.need_event();
  }

  void event(stride::Event& event) override {
    update_outputs();
    channel_.observe(event.time());
    // whoever could not end its step where its frame began may have more of this step
    if (take_frames()) return event.iterate();
    hand_over(event);
    const auto end = channel_.next_end();
    end ? event.next_event(*end) : event.no_next_event();
  }

  // While no frame is on the air the outputs are a function of the inputs, so they stay what they
  // are, field or none.
  stride::Time idle_until(stride::Time now) const override {
    const Channel::State& s = channel_.state();
    const bool is_quiet = s.down.empty() && s.up.empty();
    return is_quiet && shows_inputs() ? stride::Time::max() : now;
  }

  void update_outputs() override {
    channel_.move(reader_coil_, tag_coils_, carrier_power_);
    keep_shown();
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      tags_[i].link = channel_.link(i);
      tags_[i].snr_down = nfc_channel::decibels(tags_[i].link.snr_down);
      tags_[i].snr_up = nfc_channel::decibels(tags_[i].link.snr_up);
    }
  }

  void save_state(stride::StateWriter& writer) const override {
    const Channel::State& s = channel_.state();
    save(writer, s.observed);
    writer.write(s.forgotten), writer.write(s.frames_down), writer.write(s.frames_up);
    save(writer, s.down), save(writer, s.up);
    writer.write(shows_inputs());
  }

  // the state may come from an instance with other parameters
  void load_state(stride::StateReader& reader) override {
    channel_ = Channel(p_);
    Channel::State& s = channel_.state();
    load(reader, s.observed);
    reader.read(s.forgotten), reader.read(s.frames_down), reader.read(s.frames_up);
    load(reader, s.down), load(reader, s.up);
    const auto unknown = [this](const Reception& r) { return r.tag >= tags_.size(); };
    const auto other = [this](const Observation& o) { return o.signals.size() != tags_.size(); };
    if (s.frames_up.size() != tags_.size() ||
        std::any_of(s.observed.begin(), s.observed.end(), other) ||
        std::any_of(s.down.begin(), s.down.end(), unknown) ||
        std::any_of(s.up.begin(), s.up.end(), unknown)) {
      throw std::runtime_error("the saved state is that of a channel with other tags");
    }
    bool shows_inputs = false;
    reader.read(shows_inputs);
    shown_.reset();
    if (shows_inputs) keep_shown();
  }

 private:
  /// The inputs that the outputs are of.
  struct Shown {
    Pose reader_coil;
    std::vector<Pose> tag_coils;
    double carrier_power;
  };

  void keep_shown() {
    if (!shown_) shown_.emplace();
    shown_->reader_coil = reader_coil_;
    shown_->tag_coils = tag_coils_;
    shown_->carrier_power = carrier_power_;
  }

  bool shows_inputs() const {
    const auto is_same = [](const Pose& a, const Pose& b) {
      return a.position == b.position && a.axis == b.axis;
    };
    return shown_ && shown_->carrier_power == carrier_power_ &&
           is_same(shown_->reader_coil, reader_coil_) &&
           std::equal(tag_coils_.begin(), tag_coils_.end(), shown_->tag_coils.begin(), is_same);
  }

  bool take_frames() {
    bool any = from_reader_.clock.ticked();
    if (any) channel_.from_reader(nfc::decode(from_reader_.frame));
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const Port& from = tags_[i].from;
      if (!from.clock.ticked()) continue;
      channel_.from_tag(i, nfc::decode(from.frame));
      any = true;
    }
    return any;
  }

  // One frame to each receiver; where there might be another, in the next iteration.
  void hand_over(stride::Event& event) {
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      const auto frame = channel_.to_tag(i);
      if (!frame) continue;
      tags_[i].to.send(*frame);
      event.iterate();
    }
    if (const auto frame = channel_.to_reader()) {
      to_reader_.send(*frame);
      event.iterate();
    }
  }

  void list_coil(const std::string& name, const std::string& whose, nfc_channel::Coil& coil,
                 Pose& pose) {
    for (int i = 0; i < 3; ++i) {
      input(name + ".position." + "xyz"[i], pose.position[i])
          .unit("m")
          .description("centre of the " + whose + "'s coil");
    }
    for (int i = 0; i < 3; ++i) {
      input(name + ".axis." + "xyz"[i], pose.axis[i])
          .description("normal of the " + whose + "'s coil, of any length but zero");
    }
    list_positive(name + ".radius", coil.radius, "m", "radius of the turns");
    list_positive(name + ".turns", coil.turns, "", "number of turns");
    list_positive(name + ".wire_radius", coil.wire_radius, "m", "radius of the wire");
    list_positive(name + ".inductance", coil.inductance, "H",
                  "inductance; 0 takes it from the geometry");
    list_positive(name + ".quality_factor", coil.quality_factor, "",
                  "quality factor of the coil, damping resistors included");
  }

  /// The inputs of a coil.
  std::vector<std::string> pose_of(const std::string& coil) const {
    std::vector<std::string> names;
    for (const auto& row : variables()) {
      const bool own = row.name.compare(0, coil.size() + 1, coil + ".") == 0;
      if (own && row.causality == stride::Causality::Input) names.push_back(row.name);
    }
    return names;
  }

  void list_outputs(const TagParameters& tag, Tag& shown) {
    std::vector<std::string> poses = pose_of("reader_coil");
    for (const std::string& name : pose_of(tag.coil_name())) poses.push_back(name);
    std::vector<std::string> all = poses;
    all.push_back("carrier_power");

    const auto name = [&](const std::string& plain, const std::string& of_the_only_tag) {
      return tag.name.empty() ? of_the_only_tag : tag.name + "." + plain;
    };
    const auto list = [&](const std::string& text, double& value, const std::string& what) {
      return output(text, value).depends_on(all).description(what);
    };
    output(name("distance", "distance"), shown.link.distance)
        .unit("m")
        .min(0)
        .depends_on(poses)
        .description("distance between the coils' centres");
    output(name("coupling", "coupling"), shown.link.coupling)
        .range(0, 1)
        .depends_on(poses)
        .description("coupling factor k");
    list(name("field_strength", "field_strength"), shown.link.field_strength,
         "magnetic field of the reader at the tag, mean over the tag's coil, effective value")
        .unit("A/m")
        .min(0);
    list(name("voltage", "tag_voltage"), shown.link.tag_voltage, "amplitude at the tag's chip")
        .unit("V")
        .min(0);
    list(name("power", "tag_power"), shown.link.tag_power, "power that the tag's antenna delivers")
        .unit("W")
        .min(0);
    list(name("snr.down", "snr.down"), shown.snr_down, "Eb/N0 at the tag, at bit_rate")
        .unit("dB")
        .range(-200, 200);
    list(name("snr.up", "snr.up"), shown.snr_up, "Eb/N0 at the reader, at bit_rate")
        .unit("dB")
        .range(-200, 200);
    list(name("bit_error_rate.down", "bit_error_rate.down"), shown.link.bit_error_rate_down,
         "probability of a wrong bit at the tag, at bit_rate")
        .range(0, 0.5);
    list(name("bit_error_rate.up", "bit_error_rate.up"), shown.link.bit_error_rate_up,
         "probability of a wrong bit at the reader, at bit_rate")
        .range(0, 0.5);
  }

  void list_ports(const TagParameters& tag, Tag& ports) {
    const bool only = tag.name.empty();
    const std::string whom = only ? "the tag" : "the tag " + tag.name;
    list_output(only ? "to_tag" : tag.name + ".to", ports.to, whom);
    list_input(only ? "from_tag" : tag.name + ".from", ports.from, whom);
  }

  void list_input(const std::string& name, Port& port, const std::string& sender) {
    input(name + ".clock", port.clock).description("ticks when a frame of " + sender + " begins");
    input(name + ".frame", port.frame)
        .clocked_by(port.clock)
        .mime_type(kFrameType)
        .description("the frame as " + sender + " sends it");
  }

  void list_output(const std::string& name, Port& port, const std::string& receiver) {
    output(name + ".clock", port.clock)
        .description("ticks when a frame has ended that " + receiver + " hears");
    output(name + ".frame", port.frame)
        .clocked_by(port.clock)
        .mime_type(kFrameType)
        .depends_on({})
        .description("the frame as " + receiver + " hears it, with bit errors");
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
    const std::string name = tag.chip_name();
    list_positive(name + ".capacitance", tag.chip.capacitance, "F",
                  "parallel to the coil; 0 tunes it to the carrier");
    list_positive(name + ".load_resistance", tag.chip.load_resistance, "Ohm",
                  "rectifier and all behind it");
    list_positive(name + ".voltage_limit", tag.chip.voltage_limit, "V",
                  "amplitude at which the limiter begins to shunt");
    list_positive(name + ".modulation_resistance", tag.chip.modulation_resistance, "Ohm",
                  "switched in parallel by the load modulator");
    list_positive(name + ".power_threshold", tag.power_threshold, "W",
                  "a tag with less power does not hear");
    list_noise(name, tag.noise);
  }

  void list_reader_parameters() {
    list_positive("reader.capacitance", p_.reader.capacitance, "F",
                  "in series with the coil; 0 tunes it to the carrier");
    list_noise("reader", p_.reader.noise);
    list_positive("reader.sensitivity", p_.reader.sensitivity, "W",
                  "a reader that receives less power does not hear");
    list_positive("reader.capture_ratio", p_.reader.capture_ratio, "dB",
                  "a tag that is stronger by more masks another");
    parameter("seed", p_.seed).description("seed of the bit errors");
    parameter("bit_rate", p_.bit_rate)
        .description("for which signal-to-noise ratios and error rates are put out [kbit/s]");
  }

  static constexpr const char* kFrameType = "application/x-stride-nfc-frame";

  nfc_channel::Parameters p_;
  Pose reader_coil_;
  std::vector<Pose> tag_coils_;
  double carrier_power_ = 0.0;
  Port from_reader_;
  Port to_reader_;
  std::vector<Tag> tags_;

  Channel channel_;
  std::optional<Shown> shown_;
};

STRIDE_UNIT(NfcChannel)
