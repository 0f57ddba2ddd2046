#include "master/cli/progress.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace stride::cli {

Progress::Progress(Time start, Time stop)
    : start_(start), stop_(stop), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::on_start(std::span<const core::Signal>) {
  began_ = next_redraw_ = Clock::now();
  next_line_ = start_ + (stop_ - start_) / 10;
}

void Progress::on_communication_point(Time time) {
  last_ = time;
  if (!terminal_ && time < next_line_) return;
  const auto now = Clock::now();
  if (terminal_ && now < next_redraw_) return;
  show(time, now);
  shown_ = true;
  next_redraw_ = now + std::chrono::milliseconds(100);
  const Duration tenth = std::max((stop_ - start_) / 10, Duration(1));
  next_line_ = time + (tenth - (time - start_) % tenth);
}

void Progress::on_finish() {
  if (!shown_ || !terminal_) return;
  show(last_, Clock::now());
  fmt::print(stderr, "\n");
}

void Progress::show(Time time, Clock::time_point now) const {
  const double done = to_seconds(time - start_);
  const double whole = to_seconds(stop_ - start_);
  const double wall = std::chrono::duration<double>(now - began_).count();
  const double share = whole > 0 ? done / whole : 1;
  std::string line = fmt::format("{:5.1f} % of {:.6g} s simulated", 100 * share, whole);
  if (wall > 0.05) line += fmt::format(", {:.3g} times real time", done / wall);
  if (share > 0 && share < 1) line += fmt::format(", {:.0f} s left", wall * (1 - share) / share);
  if (terminal_) {
    fmt::print(stderr, "\r{}\033[K", line);
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
}

}  // namespace stride::cli
