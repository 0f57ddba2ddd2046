#include "units/reader/idle.h"

#include <algorithm>

namespace reader {

stride::Time axes_rest_until(const Program& program, stride::Time now) {
  const auto& tremor = program.variation.tremor;
  if (std::any_of(tremor.begin(), tremor.end(), [](double a) { return a != 0.0; })) return now;
  const auto& waypoints = program.waypoints;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    if (waypoints[i].at <= now || waypoints[i].positions == waypoints[i - 1].positions) continue;
    return std::max(now, waypoints[i - 1].at);
  }
  return stride::Time::max();
}

stride::Time idle_until(const Reader& reader, stride::Time now) {
  if (reader.is_due(now)) return now;
  const stride::Time rest = axes_rest_until(reader.program(), now);
  return std::min(rest, reader.next_event_time(now).value_or(rest));
}

}  // namespace reader
