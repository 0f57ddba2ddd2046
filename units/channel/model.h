// What the models of all technologies share: antennas that move, and a link to each tag.
#ifndef STRIDE_UNITS_CHANNEL_MODEL_H
#define STRIDE_UNITS_CHANNEL_MODEL_H

#include <cstdint>
#include <utility>
#include <vector>

#include "units/channel/air.h"
#include "units/channel/check.h"
#include "units/channel/names.h"
#include "units/channel/pose.h"

namespace channel {

/// The link to one tag at one instant. A technology derives from it and adds what it needs.
struct Link {
  double distance = 0.0;        ///< between the antennas' centres [m]
  double coupling = 0.0;        ///< 0 to 1; the technology defines it
  double field_strength = 0.0;  ///< magnetic, of the reader at the tag, effective [A/m]
  double tag_voltage = 0.0;     ///< amplitude at the tag, without load [V]
  double tag_power = 0.0;       ///< that the tag's antenna can deliver at most [W]
  Signals signals;
  double snr_down = 0.0;  ///< linear
  double snr_up = 0.0;
  double bit_error_rate_down = 0.0;  ///< 0 to 0.5
  double bit_error_rate_up = 0.0;
};

/// The names of tags that are described by structs with a `name`.
template <class Tag>
std::vector<TagName> names_of(const std::vector<Tag>& tags) {
  std::vector<TagName> names;
  for (const Tag& tag : tags) names.push_back(tag.name);
  return names;
}

/// At each instant move() before observe() (Air). `TechnologyLink` is Link or derives from it.
template <class TechnologyLink>
class Model : public Air {
 public:
  /// The poses are in the same coordinates, one for each tag; carrier power in [W], 0 for a reader
  /// whose antenna is off. Throws std::invalid_argument for an axis of length zero, a negative
  /// power or what is not a number, naming it.
  void move(const Pose& reader, const std::vector<Pose>& tags, double carrier_power) {
    require_carrier_power(carrier_power);
    require_pose("reader_coil", reader);
    carrier_power_ = carrier_power;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      require_pose(names_[i], tags[i]);
      move_tag(i, reader, tags[i], links_[i]);
    }
  }

  const TechnologyLink& link(std::size_t tag = 0) const { return links_[tag]; }

 protected:
  Model(std::vector<TagName> tags, const Rules& rules, std::uint64_t seed)
      : Air(tags.size(), rules, seed), names_(std::move(tags)), links_(names_.size()) {}

  double carrier_power() const override { return carrier_power_; }

  /// Brings `link`, which is link(index), to these poses and to the present carrier power.
  virtual void move_tag(std::size_t index, const Pose& reader, const Pose& tag,
                        TechnologyLink& link) = 0;

 private:
  std::vector<TagName> names_;
  double carrier_power_ = 0.0;
  std::vector<TechnologyLink> links_;
};

}  // namespace channel

#endif
