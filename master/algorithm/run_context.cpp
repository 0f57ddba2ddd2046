#include "master/algorithm/run_context.h"

#include <algorithm>
#include <span>
#include <utility>

#include "master/algorithm/stepping/coasting_unit.h"

namespace stride::core {
namespace {

std::vector<VariableId> observed_variables(const RunOptions& options) {
  std::vector<VariableId> ids = options.recorded;
  ids.insert(ids.end(), options.watched.begin(), options.watched.end());
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Those whose states are saved need not be saved before each step.
std::vector<std::unique_ptr<Unit>> coasting(std::vector<std::unique_ptr<Unit>> units,
                                            const System& system, const RunOptions& options,
                                            std::span<const StepOrderEntry> order,
                                            RunStatistics& statistics) {
  const auto& [each_step, most_steps, always] = options.checkpoints;
  for (const StepOrderEntry& entry : order) {
    if (!entry.saves_state) continue;
    const std::size_t i = entry.component;
    const std::size_t most = std::ranges::count(each_step, i) > 0 ? 1 : most_steps;
    units[i] =
        std::make_unique<CoastingUnit>(std::move(units[i]), *system.components()[i].description,
                                       CheckpointInterval(most, !always), statistics.units[i]);
  }
  return units;
}

}  // namespace

RunContext::RunContext(const System& system_of_run, std::vector<std::unique_ptr<Unit>> run_units,
                       RunOptions run_options)
    : system(system_of_run),
      options(std::move(run_options)),
      step_order(core::step_order(system, *options.step.policy, options.coupling)),
      statistics{.units = std::vector<UnitStatistics>(run_units.size())},
      units(coasting(std::move(run_units), system, options, step_order, statistics)),
      observed(observed_variables(options)),
      outputs(system, observed),
      exchange(system, outputs.sources()),
      clock(options.measure_time) {
  outputs.connect(exchange);
  statistics.start = statistics.reached = options.start;
}

}  // namespace stride::core
