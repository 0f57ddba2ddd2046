// A channel that does no harm: whatever is sent arrives as it was sent, when it has ended.
#ifndef STRIDE_UNITS_IDEAL_CHANNEL_MODEL_H
#define STRIDE_UNITS_IDEAL_CHANNEL_MODEL_H

#include <cstdint>
#include <vector>

#include "units/channel/air.h"
#include "units/channel/names.h"
#include "units/channel/pose.h"

namespace ideal_channel {

using channel::Pose;

struct Parameters {
  std::vector<channel::TagName> tags = std::vector<channel::TagName>(1);
  double delivered_power = 5e-3;  ///< to each tag in range, while the carrier is on [W]
  double range = 0.0;             ///< beyond which nothing arrives [m]; 0 = there is no such limit
};

struct Link {
  double distance = 0.0;  ///< [m]
  bool in_range = true;
  double tag_power = 0.0;  ///< [W]
};

/// At each instant move() before observe() (channel::Air). Both sides may send at once, and tags
/// do not disturb each other. The carrier is nothing to the frames.
class Channel : public channel::Air {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

  /// Positions in the same coordinates, one for each tag; carrier power in [W]. Throws
  /// std::invalid_argument for an axis of length zero, a negative power or what is no number,
  /// naming it.
  void move(const Pose& reader, const std::vector<Pose>& tags, double carrier_power);

  const Link& link(std::size_t tag = 0) const { return links_[tag]; }

 protected:
  double carrier_power() const override { return 1.0; }
  channel::Signals signals(std::size_t tag, double carrier_power) const override;
  double least_signal(channel::Direction, std::size_t) const override { return 0.0; }
  double bit_error_probability(channel::Direction, std::size_t, std::uint32_t, double,
                               double) const override {
    return 0.0;
  }

 private:
  Parameters parameters_;
  std::vector<Link> links_;
};

}  // namespace ideal_channel

#endif
