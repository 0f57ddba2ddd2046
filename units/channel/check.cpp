#include "units/channel/check.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace channel {
namespace {

bool is_place(const Pose& pose) { return pose.position.array().isFinite().all(); }

bool is_directed(const Pose& pose) {
  return pose.axis.array().isFinite().all() && pose.axis.norm() > 0.0;
}

}  // namespace

void out_of_range(const std::string& name, double value, const std::string& range) {
  std::ostringstream message;
  message << name << " is " << value << ": expected " << range;
  throw std::invalid_argument(message.str());
}

void require_positive(const std::string& name, double value) {
  if (!(value > 0.0 && std::isfinite(value))) out_of_range(name, value, "more than 0");
}

void require_not_negative(const std::string& name, double value) {
  if (!(value >= 0.0 && std::isfinite(value))) out_of_range(name, value, "0 or more");
}

void require_a_tag(std::size_t tag_count) {
  if (tag_count > 0) return;
  throw std::invalid_argument("the channel has no tag: expected one at least");
}

void require_pose(const std::string& antenna, const Pose& pose) {
  if (!is_place(pose)) {
    throw std::invalid_argument("the position of " + antenna + " is not finite: expected metres");
  }
  if (!is_directed(pose)) {
    throw std::invalid_argument("the axis of " + antenna +
                                " is not a direction: expected a finite normal vector, its length "
                                "not zero");
  }
}

// at each step: the name is made where it is needed only
void require_pose(const TagName& tag, const Pose& pose) {
  if (!is_place(pose) || !is_directed(pose)) require_pose(tag.coil(), pose);
}

void require_carrier_power(double power) {
  if (power >= 0.0 && std::isfinite(power)) return;
  throw std::invalid_argument("carrier_power is " + std::to_string(power) +
                              " W: expected 0 or more");
}

}  // namespace channel
