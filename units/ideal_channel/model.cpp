#include "units/ideal_channel/model.h"

#include <stdexcept>

#include "units/channel/check.h"

namespace ideal_channel {
namespace {

const Parameters& checked(const Parameters& parameters) {
  if (parameters.tags.empty()) {
    throw std::invalid_argument("the channel has no tag: expected one at least");
  }
  channel::require_not_negative("delivered_power", parameters.delivered_power);
  channel::require_not_negative("range", parameters.range);
  return parameters;
}

channel::Rules rules() {
  channel::Rules rules;
  rules.overlap = channel::Overlap::kPass;
  rules.half_duplex = false;
  return rules;
}

}  // namespace

Channel::Channel(const Parameters& parameters)
    : Air(parameters.tags.size(), rules(), 0),
      parameters_(checked(parameters)),
      links_(parameters.tags.size()) {}

void Channel::move(const Pose& reader, const std::vector<Pose>& tags, double carrier_power) {
  channel::require_carrier_power(carrier_power);
  channel::require_pose("reader_coil", reader);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    channel::require_pose(parameters_.tags[i], tags[i]);
    Link& link = links_[i];
    link.distance = (tags[i].position - reader.position).norm();
    link.in_range = parameters_.range == 0.0 || link.distance <= parameters_.range;
    link.tag_power = link.in_range && carrier_power > 0.0 ? parameters_.delivered_power : 0.0;
  }
}

channel::Signals Channel::signals(std::size_t tag, double) const {
  const double signal = links_[tag].in_range ? 1.0 : 0.0;
  return {signal, signal};
}

}  // namespace ideal_channel
