#include "units/ideal_channel/model.h"

#include <limits>

#include "units/channel/check.h"

namespace ideal_channel {
namespace {

const Parameters& checked(const Parameters& parameters) {
  channel::require_a_tag(parameters.tags.size());
  channel::require_not_negative("delivered_power", parameters.delivered_power);
  channel::require_not_negative("range", parameters.range);
  return parameters;
}

channel::Rules rules() {
  channel::Rules rules;
  rules.overlap = channel::Overlap::Pass;
  rules.half_duplex = false;
  return rules;
}

}  // namespace

Channel::Channel(const Parameters& parameters)
    : Model(parameters.tags, rules(), 0), parameters_(checked(parameters)) {}

void Channel::move_tag(std::size_t, const Pose& reader, const Pose& tag, channel::Link& link) {
  link.distance = (tag.position - reader.position).norm();
  const bool in_range = parameters_.range == 0.0 || link.distance <= parameters_.range;
  link.coupling = in_range ? 1.0 : 0.0;
  link.tag_power = in_range && Model::carrier_power() > 0.0 ? parameters_.delivered_power : 0.0;
  link.signals = {link.coupling, link.coupling};
  link.snr_down = link.snr_up = in_range ? std::numeric_limits<double>::infinity() : 0.0;
  link.bit_error_rate_down = link.bit_error_rate_up = in_range ? 0.0 : 0.5;
}

channel::Signals Channel::signals(std::size_t tag, double) const { return link(tag).signals; }

}  // namespace ideal_channel
