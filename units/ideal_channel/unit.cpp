// The channel as an FMU: the variable table, and the way from the variables to the model.
#include "units/channel/unit.h"

#include <string>
#include <vector>

#include <stride/unit.h>

#include "units/ideal_channel/model.h"

using ideal_channel::Channel;

class IdealChannel : public channel::ModelUnit<Channel, ideal_channel::Parameters> {
 public:
  explicit IdealChannel(const stride::Setup& setup)
      : ModelUnit(channel::tag_names(setup, "ideal-channel")) {
    describe_channel("Channel for debugging: every frame arrives, and power without end");
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
    list_outputs(meanings);
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
  Outputs outputs(std::size_t tag) const override {
    const ideal_channel::Link& link = channel_.link(tag);
    const double snr = link.in_range ? 200.0 : -200.0;
    const double error_rate = link.in_range ? 0.0 : 0.5;
    return {
        link.distance, link.in_range ? 1.0 : 0.0, 0.0, 0.0, link.tag_power, snr, snr, error_rate,
        error_rate};
  }
};

STRIDE_UNIT(IdealChannel)
