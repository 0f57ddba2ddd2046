#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_COMPONENT_SELECTION_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_COMPONENT_SELECTION_H

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/base/error.h"

namespace stride::scenario {

/// A glob over the names of components, and where it was written.
struct ComponentPattern {
  std::string text;
  core::Location where{};
};

/// Finds components by patterns; a name without special characters is looked up in an index. The
/// names must outlive this object.
class ComponentSelector {
 public:
  explicit ComponentSelector(std::span<const std::string> names);

  /// As select_components() does with this pattern alone.
  std::vector<std::size_t> select(const ComponentPattern& pattern) const;

 private:
  std::span<const std::string> names_;
  std::map<std::string_view, std::vector<std::size_t>> places_;
};

/// The components, by their indices in `names` and in that order, whose names match a pattern.
/// Throws core::Error (Input) for a pattern that matches none, naming what is near.
std::vector<std::size_t> select_components(std::span<const std::string> names,
                                           std::span<const ComponentPattern> patterns);

}  // namespace stride::scenario

#endif
