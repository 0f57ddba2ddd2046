#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/study/verify/checks.h"

namespace stride::verify {

// TestInstance itself fails a unit that requests Event Mode and has none, announces what is over,
// or iterates for ever; an instance, one that returns early where that is not allowed.
Finding check_events(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  const Recording run = trial.record();
  if (run.early_returns > 0 && !unit.may_return_early) {
    return failed(
        fmt::format("at {} s it returns early, which it does not declare "
                    "(mightReturnEarlyFromDoStep)",
                    core::to_text(run.first_early_return)));
  }
  const Recording obedient = trial.record({.early_return_allowed = false});
  std::string text = fmt::format("{} super-dense instants", run.events);
  if (!unit.has_event_mode) text = "no Event Mode";
  if (unit.may_return_early) {
    text += fmt::format(", {} early returns and {} where they are not allowed", run.early_returns,
                        obedient.early_returns);
  }
  if (run.has_ended) text += ", it ends the run itself";
  return passed(std::move(text));
}

}  // namespace stride::verify
