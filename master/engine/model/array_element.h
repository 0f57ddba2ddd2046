// The names of the elements of arrays, as FMI's structured naming convention has them.
#ifndef STRIDE_MASTER_ENGINE_MODEL_ARRAY_ELEMENT_H
#define STRIDE_MASTER_ENGINE_MODEL_ARRAY_ELEMENT_H

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/description.h"

namespace stride::core {

/// The name of an element: that of a scalar variable, else "name[1]" or "name[2,1]", counted from 1
/// in row-major order.
std::string element_name(const Variable& variable, std::size_t element);
std::string element_name(const std::string& array, std::span<const std::size_t> dimensions,
                         std::size_t element);

/// "2 × 3"
std::string dimensions_text(std::span<const std::size_t> dimensions);
/// "2 × 3 elements", "1 element"
std::string elements_text(std::span<const std::size_t> dimensions);
std::vector<std::size_t> sizes(const Variable& variable);

/// A name that ends in square brackets: "m[1,2]".
struct IndexedName {
  std::string array;                 ///< "m"
  std::string brackets;              ///< "[1,2]"
  std::vector<std::size_t> indices;  ///< as written; empty if these are no whole numbers
};
std::optional<IndexedName> indexed_name(const std::string& name);

/// The place of the element in row-major order. Throws Error (Input) if the array has no such
/// element.
std::size_t element_at(const Variable& array, const IndexedName& name, const Context& context);

}  // namespace stride::core

#endif
