#include "master/system/declaration/component_selection.h"

#include <set>

#include <fmt/format.h>

#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"

namespace stride::scenario {

ComponentSelector::ComponentSelector(std::span<const std::string> names) : names_(names) {
  for (std::size_t i = 0; i < names.size(); ++i) places_[names[i]].push_back(i);
}

std::vector<std::size_t> ComponentSelector::select(const ComponentPattern& pattern) const {
  std::vector<std::size_t> selected;
  if (core::is_glob(pattern.text)) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (core::means(pattern.text, names_[i])) selected.push_back(i);
    }
  } else if (const auto found = places_.find(pattern.text); found != places_.end()) {
    selected = found->second;
  }
  if (!selected.empty()) return selected;
  core::fail_input({.where = pattern.where}, fmt::format("'{}' matches no component", pattern.text),
                   core::suggestion(pattern.text, names_));
}

std::vector<std::size_t> select_components(std::span<const std::string> names,
                                           std::span<const ComponentPattern> patterns) {
  const ComponentSelector selector(names);
  std::set<std::size_t> selected;
  for (const ComponentPattern& pattern : patterns) {
    for (const std::size_t i : selector.select(pattern)) selected.insert(i);
  }
  return {selected.begin(), selected.end()};
}

}  // namespace stride::scenario
