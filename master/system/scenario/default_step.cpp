#include "master/system/scenario/default_step.h"

#include <algorithm>

namespace stride::scenario {
namespace {

constexpr Duration kUsual = std::chrono::milliseconds(1);
constexpr std::int64_t kFewest = 100;
constexpr std::int64_t kMost = 100'000;

/// The largest 1, 2 or 5 times a power of ten that is not above it.
Duration round_down(Duration duration) {
  Duration power(1);
  while (power * 10 <= duration) power *= 10;
  for (const int factor : {5, 2}) {
    if (power * factor <= duration) return power * factor;
  }
  return power;
}

}  // namespace

Duration default_step(Duration run) {
  if (run <= Duration{}) return kUsual;
  return std::clamp(kUsual, round_down(run / kMost), round_down(run / kFewest));
}

}  // namespace stride::scenario
