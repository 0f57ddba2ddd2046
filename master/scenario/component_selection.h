#ifndef STRIDE_MASTER_SCENARIO_COMPONENT_SELECTION_H
#define STRIDE_MASTER_SCENARIO_COMPONENT_SELECTION_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "master/util/error.h"

namespace stride::scenario {

/// A glob over the names of components, and where it was written.
struct ComponentPattern {
  std::string text;
  core::Location where{};
};

/// The components, by their indices in `names` and in that order, whose names match a pattern.
/// Throws core::Error (Input) for a pattern that matches none, naming what is near.
std::vector<std::size_t> select_components(std::span<const std::string> names,
                                           std::span<const ComponentPattern> patterns);

}  // namespace stride::scenario

#endif
