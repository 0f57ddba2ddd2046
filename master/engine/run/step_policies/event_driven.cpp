// Communication points only where a unit stops, has an event, or must not step further.
#include "master/engine/run/step_policies/step_limits.h"
#include "master/engine/run/step_policies/step_policy.h"

namespace stride::core {
namespace {

class EventDrivenSteps : public StepPolicy {
 public:
  EventDrivenSteps(const System& system, const RunOptions& options) : limits_(system, options) {}

  Time next(Time now) override {
    return limits_.end_of_step(now, limits_.maximum().value_or(limits_.stop() - now));
  }

 private:
  StepLimits limits_;
};

}  // namespace

const StepPolicyType kEventDrivenSteps{
    .name = "event-driven",
    .create = [](const System& system, const RunOptions& options) -> std::unique_ptr<StepPolicy> {
      return std::make_unique<EventDrivenSteps>(system, options);
    },
    .describe = [](const StepOptions&) { return std::string("from event to event"); }};

}  // namespace stride::core
