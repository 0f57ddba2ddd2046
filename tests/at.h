// Times as tests write them.
#ifndef STRIDE_TESTS_AT_H
#define STRIDE_TESTS_AT_H

#include <vector>

#include <stride/time.h>

namespace stride::tests {

inline Time at(double seconds) { return time_from_seconds(seconds); }

inline Time at_picosecond(Picoseconds count) { return Time(Duration(count)); }
inline std::vector<Time> at_picoseconds(const std::vector<std::int64_t>& counts) {
  std::vector<Time> times;
  for (const std::int64_t count : counts) times.push_back(at_picosecond(count));
  return times;
}

}  // namespace stride::tests

#endif
