#include "master/engine/run/context/run_context.h"

#include <algorithm>
#include <utility>

namespace stride::core {
namespace {

std::vector<VariableId> observed_variables(const RunOptions& options) {
  std::vector<VariableId> ids = options.recorded;
  ids.insert(ids.end(), options.watched.begin(), options.watched.end());
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace

RunContext::RunContext(const System& system_of_run, std::vector<std::unique_ptr<Unit>> run_units,
                       RunOptions run_options)
    : system(system_of_run),
      units(std::move(run_units)),
      options(std::move(run_options)),
      observed(observed_variables(options)),
      outputs(system, observed),
      exchange(system, outputs.sources(), FirstValues(system, options.start, options.warn)),
      statistics{.units = std::vector<UnitStatistics>(units.size())},
      until(options.stop),
      clock(options.measure_time) {
  outputs.connect(exchange);
  statistics.start = statistics.reached = options.start;
}

}  // namespace stride::core
