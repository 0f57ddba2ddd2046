// The places of components and of their variables, by name.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_NAME_INDEX_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_NAME_INDEX_H

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "master/engine/model/description.h"

namespace stride::core {

/// Components that have the same description share its names, so an index of many copies of one
/// unit is small.
class NameIndex {
 public:
  /// The component gets the next number. Returns whether no other has this name.
  bool add(const std::string& component, std::shared_ptr<const UnitDescription> description);

  /// The number of the component, counted from 0.
  std::optional<std::size_t> component(const std::string& name) const;
  /// The index of the component's variable with this name or alias, as UnitDescription::find() has
  /// it. Of letters with marks either form is found: see composed().
  std::optional<std::size_t> variable(std::size_t component, std::string_view name) const;

  /// The names and aliases of the component's variables that begin with the text, and the indices
  /// of these variables, sorted by name.
  std::vector<std::pair<std::string_view, std::size_t>> variables(std::size_t component,
                                                                  std::string_view beginning) const;

 private:
  struct Variables {
    explicit Variables(const UnitDescription& description);

    std::map<std::string_view, std::size_t> places;
    std::deque<std::string> composed_names;  ///< of those that are not
  };

  std::map<std::string, std::size_t> components_;
  /// The views in the maps are into these descriptions, or the composed names.
  std::map<std::shared_ptr<const UnitDescription>, std::shared_ptr<const Variables>> descriptions_;
  std::vector<std::shared_ptr<const Variables>> variables_;  ///< by component
};

}  // namespace stride::core

#endif
