// What the name of a connector denotes: a variable, an element of an array, or the scalars of one.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_CONNECTOR_ELEMENTS_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_CONNECTOR_ELEMENTS_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/description.h"
#include "master/engine/model/system/name_index.h"
#include "master/engine/model/variable_id.h"

namespace stride::core {

struct ConnectorElements {
  std::vector<ElementRange> parts;      ///< one, or scalars in row-major order
  std::vector<std::size_t> dimensions;  ///< of all of them; empty: a scalar

  std::size_t size() const { return parts.size() * parts.front().size; }
  bool are_scalars() const { return parts.size() > 1; }
};

/// "a scalar", "an array of 2 × 3 elements" or "scalars of 2 × 3 elements".
std::string shape_text(const ConnectorElements& elements);

/// The variable of that name or alias; or else, of "m[1,2]", that element of the array `m`; or else
/// the scalars "m[1,1]" to "m[2,3]", which FMI 2.0 has in place of an array `m`. Nothing if the
/// component has none of these. Throws Error (Input) if the array has no such element, or the
/// scalars are not those of a whole array.
std::optional<ConnectorElements> find_elements(const NameIndex& names, std::size_t component,
                                               const UnitDescription& description,
                                               const Context& context);

}  // namespace stride::core

#endif
