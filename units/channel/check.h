// What a parameter may be.
#ifndef STRIDE_UNITS_CHANNEL_CHECK_H
#define STRIDE_UNITS_CHANNEL_CHECK_H

#include <cstddef>
#include <string>

#include "units/channel/names.h"
#include "units/channel/pose.h"

namespace channel {

/// Throws std::invalid_argument: "`name` is `value`: expected `range`".
[[noreturn]] void out_of_range(const std::string& name, double value, const std::string& range);

// These throw it for a value that is not finite, too.
void require_positive(const std::string& name, double value);
void require_not_negative(const std::string& name, double value);

/// Throws std::invalid_argument for a channel that has no tag.
void require_a_tag(std::size_t tag_count);

/// Throws std::invalid_argument for an antenna at no place, or with an axis of length zero.
void require_pose(const std::string& antenna, const Pose& pose);
void require_pose(const TagName& tag, const Pose& pose);

/// Throws std::invalid_argument for a power [W] that is negative or no number.
void require_carrier_power(double power);

}  // namespace channel

#endif
