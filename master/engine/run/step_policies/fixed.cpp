// Communication points on a grid.
#include <algorithm>

#include <fmt/format.h>

#include "master/engine/model/time/grid.h"
#include "master/engine/run/step_policies/step_limits.h"
#include "master/engine/run/step_policies/step_policy.h"

namespace stride::core {
namespace {

class FixedSteps : public StepPolicy {
 public:
  FixedSteps(const System& system, const RunOptions& options)
      : limits_(system, options),
        grid_(options.start, options.step.size),
        last_(std::max(options.start, limits_.stop() - grid_.negligible())),
        is_limited_(limits_.are_below(grid_.step())),
        point_(options.start) {}

  Time next(Time now) override {
    move_to((now == point_ ? index_ : grid_.index_at(now)) + 1);
    return is_limited_ ? limits_.limited(now, point_) : point_;
  }

  Time next_while_idle(Time now, Time quiet_until) override {
    const Time regular = next(now);
    const Time farthest = limits_.limited(now, std::min(quiet_until, limits_.stop()));
    if (farthest <= regular) return regular;
    if (farthest == limits_.stop()) return farthest;
    move_to(grid_.index_at(std::min(farthest, last_ - Duration(1))));
    return point_;
  }

  const Grid* regular_grid(Time now) const override {
    return !is_limited_ && (now == point_ || grid_.has(now)) ? &grid_ : nullptr;
  }

 private:
  /// The last step takes in what remains of the run, if that is negligible.
  void move_to(std::uint64_t index) {
    index_ = index;
    point_ = grid_.point(index);
    if (point_ >= last_) point_ = limits_.stop();
  }

  StepLimits limits_;
  Grid grid_;
  Time last_;  ///< a point from here on is the end of the run
  bool is_limited_;
  std::uint64_t index_ = 0;
  Time point_;  ///< the last target on the grid
};

}  // namespace

const StepPolicyType kFixedSteps{
    .name = "fixed",
    .has_grid = true,
    .create = [](const System& system, const RunOptions& options) -> std::unique_ptr<StepPolicy> {
      return std::make_unique<FixedSteps>(system, options);
    },
    .describe =
        [](const StepOptions& options) {
          return fmt::format("in steps of {} s", to_text(options.size));
        }};

}  // namespace stride::core
