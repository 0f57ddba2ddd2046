// Times as people write them.
#ifndef STRIDE_MASTER_BASE_TIME_TEXT_H
#define STRIDE_MASTER_BASE_TIME_TEXT_H

#include <chrono>
#include <string>
#include <string_view>

#include <stride/time.h>

namespace stride::core {

/// The exact decimal text of a time in seconds, without trailing zeros: "14.2".
std::string to_text(Time time);
std::string to_text(Duration duration);

/// A decimal number of seconds, such as "14.2", "1e-3" or " 30 ", as a count of picoseconds. No
/// double comes between, so twelve decimals are exact; further ones are rounded half up. Throws
/// std::invalid_argument, whose text contains what was expected, for what is negative, too large,
/// no number, or another one than 0 that would be rounded to 0.
Duration parse_seconds(std::string_view text);

/// Likewise an instant, which may be before 0: "-0.5".
Time parse_time(std::string_view text);

/// Seconds that a computation took, with three decimals.
std::string wall_seconds(std::chrono::nanoseconds time);

}  // namespace stride::core

#endif
