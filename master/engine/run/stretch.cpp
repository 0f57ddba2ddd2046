#include "master/engine/run/stretch.h"

#include <algorithm>

namespace stride::core {

Stretch::Stretch(RunContext& context, const Parts& parts, bool is_possible)
    : context_(context),
      parts_(parts),
      is_possible_(is_possible && context.options.steps_in_stretches),
      size_(context.options.step.size.rounded()),
      interrupted_(context.options.interrupted) {}

/// The steps end before that.
Time Stretch::free_until() const {
  const Time event = std::min(context_.until, parts_.event_handler.quiet_until());
  return std::min(parts_.interventions.next(event), parts_.pauses.may_be_due_from());
}

std::uint64_t Stretch::steps_from(Time now) const {
  if (!is_possible_ || !parts_.stepper.may_be_regular()) return 0;
  const std::uint64_t unmeasured = parts_.sampling.unmeasured_steps();
  if (unmeasured == 0) return 0;
  const Time end = free_until();
  if (end <= now || end - now <= size_) return 0;
  const Grid* const grid = parts_.policy.regular_grid(now);
  if (grid == nullptr) return 0;
  const Time last = std::min(end, context_.options.stop - grid->negligible()) - Duration(1);
  if (last <= now) return 0;
  return std::min(unmeasured, grid->index_at(last) - grid->index_at(now));
}

std::optional<Time> Stretch::make(Time& time, std::uint64_t steps) {
  const Grid& grid = *parts_.policy.regular_grid(time);
  const double size_seconds = grid.seconds(size_);
  if (grid.is_narrow(steps, time)) {
    return walk(Grid::NarrowWalk(grid, time), size_seconds, time, steps);
  }
  return walk(Grid::Walk(grid, time), size_seconds, time, steps);
}

/// `next` is at `time`.
template <class Walk>
inline std::optional<Time> Stretch::walk(Walk next, double size_seconds, Time& time,
                                         std::uint64_t steps) {
  double seconds = next.seconds();
  Time reached;
  for (std::uint64_t made = 0; made < steps && !is_interrupted(); ++made) {
    parts_.sampling.pass_step();
    next.advance();
    const StepInterval interval(time, seconds, next.time(), next.seconds(), size_seconds);
    if (!parts_.stepper.advance_regularly(interval, reached)) [[unlikely]]
      return reached;
    time = interval.to;
    seconds = interval.end_seconds;
    parts_.event_handler.pass_quietly(interval.to);
    observe(interval.to);
  }
  return std::nullopt;
}

inline void Stretch::observe(const Time& time) {
  ++context_.statistics.communication_steps;
  context_.statistics.reached = time;
  context_.outputs.update(time);
  for (Observer* observer : context_.observers) observer->on_communication_point(time);
}

}  // namespace stride::core
