#include "units/channel/check.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace channel {

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

void require_pose(const std::string& antenna, const Pose& pose) {
  const auto finite = [](const Eigen::Vector3d& v) { return v.array().isFinite().all(); };
  if (!finite(pose.position)) {
    throw std::invalid_argument("the position of " + antenna + " is not finite: expected metres");
  }
  if (!finite(pose.axis) || !(pose.axis.norm() > 0.0)) {
    throw std::invalid_argument("the axis of " + antenna +
                                " is no direction: expected a finite normal vector, its length "
                                "not zero");
  }
}

void require_carrier_power(double power) {
  if (power >= 0.0 && std::isfinite(power)) return;
  throw std::invalid_argument("carrier_power is " + std::to_string(power) +
                              " W: expected 0 or more");
}

}  // namespace channel
