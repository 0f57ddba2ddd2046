// The log categories of a unit (FMI 3.0, 2.4.5), one for each kind of message.
#ifndef STRIDE_INTERFACES_UNIT_LOG_CATEGORIES_H
#define STRIDE_INTERFACES_UNIT_LOG_CATEGORIES_H

#include <cstdint>

namespace stride::kit {

/// Bits, so that a set of categories is a mask.
enum LogCategory : std::uint8_t {
  LogErrors = 1,    ///< why a function returned fmi3Error or fmi3Discard
  LogWarnings = 2,  ///< warnings of the unit and of the kit
  LogEvents = 4,    ///< the unit's own events
};

inline constexpr std::uint8_t kAllLogCategories = LogErrors | LogWarnings | LogEvents;

struct NamedLogCategory {
  LogCategory category;
  const char* name;
};

inline constexpr NamedLogCategory kLogCategories[] = {
    {LogErrors, "logStatusError"}, {LogWarnings, "logStatusWarning"}, {LogEvents, "logEvents"}};

constexpr const char* name(LogCategory category) {
  for (const NamedLogCategory& known : kLogCategories) {
    if (known.category == category) return known.name;
  }
  return "";
}

}  // namespace stride::kit

#endif
