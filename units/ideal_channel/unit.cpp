// The channel as an FMU: the variable table, and the way from the variables to the model.
#include "units/channel/unit.h"

#include <string>
#include <vector>

#include <stride/unit.h>

#include "units/ideal_channel/model.h"

using ideal_channel::Channel;

class IdealChannel : public channel::ChannelUnit {
 public:
  explicit IdealChannel(const stride::Setup& setup)
      : ChannelUnit(channel::tag_names(setup, "ideal-channel")) {
    p_.tags = tags();
    channel_ = Channel(p_);
    auto& info = describe("Channel for debugging: every frame arrives, and power without end");
    info.promises_idle = true;
    info.split_invariant = true;
    const std::string axis = "of any length but zero; it does not matter";
    list_reader_pose("the reader's antenna", axis);
    for (std::size_t i = 0; i < tags().size(); ++i) {
      list_tag_pose(i, "the antenna of the " + tags()[i].text(), axis);
    }
    list_carrier_power("whether tags get power");
    const Meanings meanings{"distance between the antennas",
                            "1 in range, 0 out of it",
                            "not modelled, 0",
                            "not modelled, 0",
                            "delivered_power in range, while the carrier is on",
                            "200 dB in range, -200 dB out of it,",
                            ""};
    shown_.resize(tags().size());
    for (std::size_t i = 0; i < tags().size(); ++i) list_outputs(i, shown_[i], meanings);
    list_frames();
    parameter("delivered_power", p_.delivered_power)
        .unit("W")
        .min(0)
        .description("to each tag in range, while the carrier is on");
    parameter("range", p_.range)
        .unit("m")
        .min(0)
        .description("beyond which nothing arrives; 0 = there is no such limit");
    state();
  }

 private:
  void make() override { channel_ = Channel(p_); }
  channel::Air& air() override { return channel_; }
  const channel::Air& air() const override { return channel_; }

  void show(const Inputs& inputs) override {
    channel_.move(inputs.reader_coil, inputs.tag_coils, inputs.carrier_power);
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const ideal_channel::Link& link = channel_.link(i);
      const double snr = link.in_range ? 200.0 : -200.0;
      const double error_rate = link.in_range ? 0.0 : 0.5;
      shown_[i] = {
          link.distance, link.in_range ? 1.0 : 0.0, 0.0, 0.0, link.tag_power, snr, snr, error_rate,
          error_rate};
    }
  }

  ideal_channel::Parameters p_;
  Channel channel_;
  std::vector<Outputs> shown_;
};

STRIDE_UNIT(IdealChannel)
