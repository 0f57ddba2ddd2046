// Communication points on a grid.
#include <algorithm>

#include <fmt/format.h>

#include "master/algorithm/step_policies/step_limits.h"
#include "master/algorithm/step_policies/step_policy.h"
#include "master/util/time_text.h"

namespace stride::core {
namespace {

class FixedSteps : public StepPolicy {
 public:
  FixedSteps(const System& system, const RunOptions& options)
      : limits_(system, options), size_(options.step.size), grid_point_(options.start) {}

  Time next(Time now) override {
    Time target = limits_.stop();
    const Duration since = now == grid_point_ ? Duration{} : (now - limits_.start()) % size_;
    if (limits_.stop() - now > size_ - since) target = now + (size_ - since);
    grid_point_ = target;
    return limits_.limited(now, target);
  }

  Time next_while_idle(Time now, Time quiet_until) override {
    const Time regular = next(now);
    const Time farthest = limits_.limited(now, std::min(quiet_until, limits_.stop()));
    if (farthest <= regular) return regular;
    if (farthest == limits_.stop()) return farthest;
    grid_point_ = farthest - (farthest - limits_.start()) % size_;
    return grid_point_;
  }

  Duration regular_size(Time now) const override {
    const bool is_on_grid = now == grid_point_ || (now - limits_.start()) % size_ == Duration{};
    return is_on_grid && size_ <= limits_.maximum().value_or(size_) ? size_ : Duration{};
  }

 private:
  StepLimits limits_;
  Duration size_;
  Time grid_point_;  ///< the last target on the grid
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
