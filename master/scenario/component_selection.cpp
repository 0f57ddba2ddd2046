#include "master/scenario/component_selection.h"

#include <set>

#include <fmt/format.h>

#include "master/util/glob.h"
#include "master/util/suggest.h"

namespace stride::scenario {

std::vector<std::size_t> select_components(std::span<const std::string> names,
                                           std::span<const ComponentPattern> patterns) {
  std::set<std::size_t> selected;
  for (const ComponentPattern& pattern : patterns) {
    bool has_match = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != pattern.text && !core::matches_glob(pattern.text, names[i])) continue;
      has_match = true;
      selected.insert(i);
    }
    if (has_match) continue;
    core::fail_input({.where = pattern.where},
                     fmt::format("'{}' matches no component", pattern.text),
                     core::suggestion(pattern.text, names));
  }
  return {selected.begin(), selected.end()};
}

}  // namespace stride::scenario
