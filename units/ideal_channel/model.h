// A channel that does no harm: whatever is sent arrives as it was sent, when it has ended.
#ifndef STRIDE_UNITS_IDEAL_CHANNEL_MODEL_H
#define STRIDE_UNITS_IDEAL_CHANNEL_MODEL_H

#include <cstdint>
#include <vector>

#include "units/channel/model.h"
#include "units/channel/names.h"

namespace ideal_channel {

using channel::Pose;

struct Parameters {
  std::vector<channel::TagName> tags = std::vector<channel::TagName>(1);
  double delivered_power = 5e-3;  ///< to each tag in range, while the carrier is on [W]
  double range = 0.0;             ///< beyond which nothing arrives [m]; 0 = there is no such limit
};

/// Both sides may send at once, and tags do not disturb each other. The frames do not depend on the
/// carrier. Of a link the coupling is 1 in range and 0 out of it.
class Channel : public channel::Model<channel::Link> {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

 protected:
  void move_tag(std::size_t index, const Pose& reader, const Pose& tag,
                channel::Link& link) override;
  double carrier_power() const override { return 1.0; }
  channel::Signals signals(std::size_t tag, double carrier_power) const override;
  double least_signal(channel::Direction, std::size_t) const override { return 0.0; }
  double bit_error_probability(channel::Direction, std::size_t, std::uint32_t, double,
                               double) const override {
    return 0.0;
  }

 private:
  Parameters parameters_;
};

}  // namespace ideal_channel

#endif
