#include "master/front/cli/check/remote_check.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "master/engine/model/time/grid.h"
#include "master/front/cli/terminal/table.h"
#include "master/loader/network/remote_unit.h"

namespace stride::cli {
namespace {

double milliseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// Units elsewhere are awaited together where they are in one stage, so the slowest one counts.
std::string cost_text(const core::RunOptions& options, std::chrono::nanoseconds round_trip) {
  if (!options.step.policy->has_grid) {
    return fmt::format("Each communication step waits for a round trip of {:.3g} ms.\n",
                       milliseconds(round_trip));
  }
  const auto steps = core::Grid(options.start, options.step.size).index_at(options.stop);
  return fmt::format(
      "{} communication steps wait for a round trip of {:.3g} ms each: {:.3g} s at least, and more "
      "for events, steps that are redone and units that wait for each other.\n",
      steps, milliseconds(round_trip),
      milliseconds(round_trip) / 1000 * static_cast<double>(steps));
}

}  // namespace

std::string remote_table(const scenario::RunPlan& loaded) {
  Table table({{"component"},
               {"machine"},
               {"FMU there"},
               {"connecting [ms]", Table::Align::Right},
               {"round trip [ms]", Table::Align::Right}});
  std::chrono::nanoseconds slowest{};
  for (std::size_t i = 0; i < loaded.hostings().size(); ++i) {
    const std::optional<scenario::Hosting>& hosting = loaded.hostings()[i];
    if (!hosting || !hosting->remote) continue;
    const core::ComponentDeclaration& component = loaded.scenario().system.components[i];
    const remote::Trial trial = remote::try_connection(*hosting->remote, component.where);
    slowest = std::max(slowest, trial.round_trip);
    table.add({component.name, hosting->remote->place.machine,
               hosting->remote->sent.empty() ? hosting->remote->fmu : "(sent)",
               fmt::format("{:.3g}", milliseconds(trial.connecting)),
               fmt::format("{:.3g}", milliseconds(trial.round_trip))});
  }
  if (table.size() == 0) return "";
  return "\nOn other machines\n" + table.text() + cost_text(loaded.options(), slowest);
}

}  // namespace stride::cli
