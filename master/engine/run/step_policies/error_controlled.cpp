// Steps as long as the error of the inputs between communication points stays tolerable.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/run/step_policies/step_limits.h"
#include "master/engine/run/step_policies/step_policy.h"
#include "master/engine/run/step_policies/step_size_controller.h"
#include "master/engine/run/stepping/input_extrapolator.h"

namespace stride::core {
namespace {

class ErrorControlledSteps : public StepPolicy {
 public:
  ErrorControlledSteps(const System& system, const RunOptions& options)
      : system_(system),
        limits_(system, options, std::max((options.stop - options.start) / 10, Duration(1))),
        minimum_(options.step.minimum.rounded()),
        controller_(options.step.size.rounded(), 1.0 + static_cast<double>(options.extrapolation)) {
  }

  Time next(Time now) override {
    return limits_.end_of_step(now, std::min(controller_.size(), *limits_.maximum()));
  }

  bool accept(Time from, Time reached, const ExtrapolationError& error) override {
    const Duration used = reached - from;
    if (used == Duration{}) return true;
    if (error.ratio <= 1) {
      controller_.accept(used, error.ratio, {minimum_, *limits_.maximum()});
      return true;
    }
    const Duration least = std::max(minimum_, limits_.quantum().rounded());
    if (used <= least) fail_tolerance(from, used, error);
    controller_.reject(used, error.ratio, least);
    return false;
  }

  void persist(StateArchive& state) override { controller_.persist(state); }

 private:
  [[noreturn]] void fail_tolerance(Time from, Duration used,
                                   const ExtrapolationError& error) const {
    const bool is_grid = limits_.quantum() > Interval(minimum_);
    fail_run(
        {{},
         system_.components()[error.output.component].name,
         system_.variable(error.output).name,
         from},
        fmt::format("over a step of {} s the output changes by {:.3g} times what the inputs that "
                    "it feeds may be off by, and no shorter step is {}",
                    to_text(used), error.ratio,
                    is_grid ? fmt::format("possible, since steps end on the units' fixed internal "
                                          "steps (fixedInternalStepSize) of {} s",
                                          to_text(limits_.quantum()))
                            : "allowed"),
        is_grid ? "loosen the tolerances, or export the unit with a smaller internal step"
                : "loosen the tolerances, allow a smaller minimum step, or let the unit announce "
                  "the jump as an event");
  }

  const System& system_;
  StepLimits limits_;
  Duration minimum_;
  StepSizeController controller_;
};

}  // namespace

const StepPolicyType kErrorControlledSteps{
    .name = "error-controlled",
    .controls_error = true,
    .create = [](const System& system, const RunOptions& options) -> std::unique_ptr<StepPolicy> {
      return std::make_unique<ErrorControlledSteps>(system, options);
    },
    .describe =
        [](const StepOptions& options) {
          return fmt::format("in steps that keep the inputs' error within {} + {} of their values",
                             options.absolute_tolerance, options.relative_tolerance);
        }};

}  // namespace stride::core
