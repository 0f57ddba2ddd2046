#include "units/channel/check.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace channel;
using Catch::Contains;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("A number out of its range is refused with its name, its value and the range") {
  CHECK_THROWS_WITH(out_of_range("reader.turns", -2.5, "more than 0"),
                    "reader.turns is -2.5: expected more than 0");
  CHECK_NOTHROW(require_positive("x", 1e-30));
  CHECK_NOTHROW(require_not_negative("x", 0.0));
  CHECK_THROWS_WITH(require_positive("x", 0.0), Contains("more than 0"));
  for (const double value : {-1e-30, kNan, kInfinity}) {
    CHECK_THROWS_WITH(require_positive("x", value), Contains("x is "));
    CHECK_THROWS_WITH(require_not_negative("x", value), Contains("0 or more"));
    CHECK_THROWS_WITH(require_carrier_power(value), Contains("carrier_power is "));
  }
  CHECK_NOTHROW(require_carrier_power(0.0));
}

TEST_CASE("An antenna is at a place and points somewhere") {
  Pose pose;
  CHECK_NOTHROW(require_pose("tag_coil", pose));
  pose.axis.setZero();
  CHECK_THROWS_WITH(require_pose("tag_coil", pose), Contains("the axis of tag_coil"));
  pose.axis = {0, kNan, 1};
  CHECK_THROWS_WITH(require_pose("tag_coil", pose), Contains("the axis of tag_coil"));
  pose.position.x() = kInfinity;
  CHECK_THROWS_WITH(require_pose("tag_coil", pose), Contains("the position of tag_coil"));
  CHECK_THROWS_WITH(require_pose(TagName{"door"}, pose), Contains("the position of door.coil"));
  CHECK_NOTHROW(require_pose(TagName{}, Pose{}));
}
