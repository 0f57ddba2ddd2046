#include <algorithm>
#include <sstream>

#include <stride/systemc/sampling.h>

namespace stride::systemc::detail {

void Sampling::begin_step(Duration size, Duration period, bool has_changed) {
  if (has_changed && last_ > period && period > Duration{}) {
    ++changes_;
    longest_ = std::max(longest_, last_);
  }
  last_ = size;
}

std::string Sampling::warning(Duration period) const {
  if (changes_ < kFewest) return "";
  std::ostringstream text;
  text << "inputs changed at the ends of " << changes_ << " steps of up to " << to_seconds(longest_)
       << " s, but the clock has a period of " << to_seconds(period)
       << " s, so each value was sampled in many cycles; where each cycle needs its own, choose a "
          "step "
          "of "
       << to_seconds(period) << " s (--step " << to_seconds(period) << ")";
  return text.str();
}

}  // namespace stride::systemc::detail
