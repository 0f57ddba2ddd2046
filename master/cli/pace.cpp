#include "master/cli/pace.h"

namespace stride::cli {

void Pace::note(Clock::time_point now, Time time) {
  last_ = {now, time};
  const Note& newest = notes_[(oldest_ + kNotes - 1) % kNotes];
  if (now - newest.wall < kInterval) return;
  notes_[oldest_] = last_;
  oldest_ = (oldest_ + 1) % kNotes;
}

double Pace::speed() const {
  const Note& before = notes_[oldest_];
  const double wall = std::chrono::duration<double>(last_.wall - before.wall).count();
  return wall > 0 ? to_seconds(last_.simulated - before.simulated) / wall : 0;
}

}  // namespace stride::cli
