#ifndef STRIDE_MASTER_ENGINE_MODEL_VARIABLE_ID_H
#define STRIDE_MASTER_ENGINE_MODEL_VARIABLE_ID_H

#include <compare>
#include <cstddef>

namespace stride::core {

/// A variable of a component, by its indices in System::components() and
/// UnitDescription::variables.
struct VariableId {
  std::size_t component = 0;
  std::size_t variable = 0;
  auto operator<=>(const VariableId&) const = default;
};

/// Adjacent elements of a variable; a scalar has one.
struct ElementRange {
  VariableId id;
  std::size_t first = 0;
  std::size_t size = 1;
  auto operator<=>(const ElementRange&) const = default;

  /// Whether they have an element in common, or are the same.
  bool overlaps(const ElementRange& other) const {
    return *this == other ||
           (id == other.id && first < other.first + other.size && other.first < first + size);
  }
};

}  // namespace stride::core

#endif
