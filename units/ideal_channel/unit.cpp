// The channel as an FMU: the variable table, and the way from the variables to the model.
#include "units/channel/unit.h"

#include <stride/unit.h>

#include "units/ideal_channel/model.h"

using ideal_channel::Channel;

class IdealChannel : public channel::ModelUnit<Channel, ideal_channel::Parameters> {
 public:
  explicit IdealChannel(const stride::Setup& setup)
      : ModelUnit(channel::tag_names(setup, "ideal-channel")) {
    describe_channel("Channel for debugging: every frame arrives, and power without end");
    list_antenna_poses("of any length but zero; it does not matter");
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
};

STRIDE_UNIT(IdealChannel)
