// The variables that the channels of all technologies have, so that one can replace another.
#ifndef STRIDE_UNITS_CHANNEL_UNIT_H
#define STRIDE_UNITS_CHANNEL_UNIT_H

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <stride/unit.h>

#include "units/channel/model.h"
#include "units/channel/names.h"
#include "units/channel/pose.h"

namespace channel {

/// The tags that the unit is packed with: those of `channel.xml` in the resources, whose root
/// element is `root`, or one without a name.
std::vector<TagName> tag_names(const stride::Setup& setup, const std::string& root);

/// The antennas' poses, the carrier, the clocks and frames, the events at which frames are handed
/// over, the promise to be idle, the state. A technology lists these variables and its own in the
/// order of the variable table, and defines how its model is made and moved.
///
/// While no frame is on the air the outputs are a function of the inputs, so they stay what they
/// are, field or none.
class ChannelUnit : public stride::Unit {
 public:
  void initialize(stride::Time now) override;
  void step(stride::Step& step) override;
  void event(stride::Event& event) override;
  void update_outputs() override;
  stride::Time idle_until(stride::Time now) const override;
  std::string describe_message(const stride::Variable& variable,
                               const stride::Binary& value) const override;
  void save_state(stride::StateWriter& writer) const override;
  void load_state(stride::StateReader& reader) override;

 protected:
  /// What the model is of.
  struct Inputs {
    Pose reader_coil;
    std::vector<Pose> tag_coils;
    double carrier_power = 0.0;  ///< [W]

    bool operator==(const Inputs& other) const {
      return reader_coil == other.reader_coil && tag_coils == other.tag_coils &&
             carrier_power == other.carrier_power;
    }
  };

  /// What the outputs mean where technologies differ.
  struct Meanings {
    std::string distance, coupling, field_strength, voltage, power, snr;
    std::string bit_rate;  ///< for which the ratios and the error rates are
  };

  explicit ChannelUnit(std::vector<TagName> tags);

  /// The model, anew from the parameters.
  virtual void make() = 0;
  virtual Air& air() = 0;
  virtual const Air& air() const = 0;
  /// Brings the model to these inputs.
  virtual void move(const Inputs& inputs) = 0;
  /// Of the model where it is.
  virtual const Link& link(std::size_t tag) const = 0;

  const std::vector<TagName>& tags() const { return names_; }

  void describe_channel(const std::string& description);
  void list_reader_pose(const std::string& place, const std::string& axis);
  void list_tag_pose(std::size_t tag, const std::string& place, const std::string& axis);
  /// The poses of all, where they are the antennas'.
  void list_antenna_poses(const std::string& axis);
  void list_carrier_power(const std::string& description);
  /// Of all tags.
  void list_outputs(const Meanings& meanings);
  /// That the link to a tag depends on: poses, carrier power.
  std::vector<std::string> inputs_of(std::size_t tag) const;
  /// All clocks and frames.
  void list_frames();

 private:
  /// Of the link to one tag.
  struct Outputs {
    double distance = 0.0;        ///< [m]
    double coupling = 0.0;        ///< 0 to 1
    double field_strength = 0.0;  ///< [A/m]
    double voltage = 0.0;         ///< [V]
    double power = 0.0;           ///< [W]
    double snr_down = 0.0;        ///< [dB], -200 to 200
    double snr_up = 0.0;
    double bit_error_rate_down = 0.0;  ///< 0 to 0.5
    double bit_error_rate_up = 0.0;
  };
  /// A clock and the frame that comes with its tick.
  struct Port {
    stride::Clock clock;
    stride::Binary frame;

    void send(const nfc::Frame& heard);
  };
  struct TagPorts {
    Port from, to;
  };

  static Outputs outputs_of(const Link& link);
  void list_outputs(std::size_t tag, const Meanings& meanings);
  std::vector<std::string> poses_of(std::size_t tag) const;
  void list_pose(const std::string& name, Pose& pose, const std::string& place,
                 const std::string& axis);
  void list_input(const std::string& name, Port& port, const std::string& sender);
  void list_output(const std::string& name, Port& port, const std::string& receiver);
  bool take_frames();
  void hand_over(stride::Event& event);

  std::vector<TagName> names_;
  Inputs inputs_;
  Port from_reader_;
  Port to_reader_;
  std::vector<TagPorts> ports_;
  std::vector<Outputs> outputs_;
  std::optional<Inputs> shown_;  ///< that the outputs are of
};

/// The channel of a technology: its model, a channel::Model, which is made from its parameters.
/// Parameters has a list `tags`, of names or of structs with a `name`.
template <class Technology, class Parameters>
class ModelUnit : public ChannelUnit {
 protected:
  explicit ModelUnit(std::vector<TagName> tags)
      : ChannelUnit(std::move(tags)), p_(parameters_of(this->tags())), channel_(p_) {}

  void make() override { channel_ = Technology(p_); }
  Air& air() override { return channel_; }
  const Air& air() const override { return channel_; }
  void move(const Inputs& inputs) override {
    channel_.move(inputs.reader_coil, inputs.tag_coils, inputs.carrier_power);
  }
  const Link& link(std::size_t tag) const override { return channel_.link(tag); }

  Parameters p_;
  Technology channel_;

 private:
  static Parameters parameters_of(const std::vector<TagName>& tags) {
    Parameters parameters;
    parameters.tags.resize(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) name_of(parameters.tags[i]) = tags[i];
    return parameters;
  }
  static TagName& name_of(TagName& tag) { return tag; }
  template <class Tag>
  static TagName& name_of(Tag& tag) {
    return tag.name;
  }
};

}  // namespace channel

#endif
