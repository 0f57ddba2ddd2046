#include "master/scenario/plot_selection.h"

#include <set>

#include <fmt/format.h>

#include "master/recorders/signal_text.h"
#include "master/scenario/signal_names.h"
#include "master/util/suggest.h"

namespace stride::io {
namespace {

[[noreturn]] void fail_without_match(const core::System& system,
                                     std::span<const core::VariableId> recorded,
                                     const PlotPattern& plot, const SignalPattern& pattern) {
  std::vector<std::string> names;
  for (const core::VariableId id : recorded) names.push_back(system.full_name(id));
  core::fail_input({.where = pattern.where},
                   fmt::format("the plot '{}' wants '{}', which matches no signal that is recorded",
                               plot.title, pattern.text),
                   core::suggestion(pattern.text, names));
}

/// Adds the columns of what the pattern matches; tells whether that is anything.
bool add_matches(const core::System& system, std::span<const core::VariableId> recorded,
                 const SignalPattern& pattern, std::set<core::VariableId>& taken, Plot& plot) {
  bool has_match = false;
  for (const core::VariableId id : recorded) {
    if (!is_meant(system, id, pattern.text)) continue;
    has_match = true;
    if (!taken.insert(id).second) continue;
    for (std::size_t i = 0; i < system.variable(id).size; ++i) {
      plot.signals.push_back(column_name(system, id, i));
    }
  }
  return has_match;
}

/// Calls miss(plot, pattern) for a pattern that matches nothing.
template <class Miss>
std::vector<Plot> matching_plots(const core::System& system,
                                 std::span<const core::VariableId> recorded,
                                 std::span<const PlotPattern> patterns, Miss&& miss) {
  std::vector<Plot> plots;
  for (const PlotPattern& wanted : patterns) {
    Plot& plot = plots.emplace_back(Plot{wanted.title, {}});
    std::set<core::VariableId> taken;
    for (const SignalPattern& pattern : wanted.signals) {
      if (!add_matches(system, recorded, pattern, taken, plot)) miss(wanted, pattern);
    }
  }
  return plots;
}

}  // namespace

std::vector<Plot> select_plots(const core::System& system,
                               std::span<const core::VariableId> recorded,
                               std::span<const PlotPattern> patterns) {
  return matching_plots(system, recorded, patterns,
                        [&](const PlotPattern& plot, const SignalPattern& pattern) {
                          fail_without_match(system, recorded, plot, pattern);
                        });
}

std::vector<Plot> remaining_plots(const core::System& system,
                                  std::span<const core::VariableId> recorded,
                                  std::span<const PlotPattern> patterns) {
  std::vector<Plot> plots =
      matching_plots(system, recorded, patterns, [](const PlotPattern&, const SignalPattern&) {});
  std::erase_if(plots, [](const Plot& plot) { return plot.signals.empty(); });
  return plots;
}

}  // namespace stride::io
