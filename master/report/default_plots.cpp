#include "master/report/default_plots.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace stride::report {
namespace {

/// Components of nested systems have points in their names, so the longest one counts.
std::string component_of(const std::string& signal,
                         std::span<const RunFile::Component> components) {
  std::string_view longest;
  for (const auto& [name, model] : components) {
    const bool is_before = signal.starts_with(name) && signal.substr(name.size()).starts_with('.');
    if (is_before && name.size() > longest.size()) longest = name;
  }
  if (!components.empty()) return std::string(longest);
  return signal.substr(0, std::min(signal.find('.'), signal.size()));
}

std::string title(const std::string& component, const Column& column) {
  const std::string whose = component.empty() ? "outputs" : component;
  if (!core::is_real(column.type())) return fmt::format("{}: states and counts", whose);
  return column.unit().empty() ? whose : fmt::format("{} [{}]", whose, column.unit());
}

}  // namespace

std::vector<recorders::Plot> default_plots(std::span<const Column> columns,
                                           std::span<const RunFile::Component> components) {
  std::vector<recorders::Plot> plots;
  for (const Column& column : columns) {
    const std::string wanted = title(component_of(column.name(), components), column);
    auto plot = std::find_if(plots.begin(), plots.end(),
                             [&](const recorders::Plot& p) { return p.title == wanted; });
    if (plot == plots.end()) plot = plots.insert(plot, {wanted, {}});
    plot->signals.push_back(column.name());
  }
  return plots;
}

}  // namespace stride::report
