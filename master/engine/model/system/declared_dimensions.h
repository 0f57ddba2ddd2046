// The dimensions that a connector or a value declares, beside those of the unit.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_DECLARED_DIMENSIONS_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_DECLARED_DIMENSIONS_H

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/engine/model/description.h"
#include "master/engine/model/system_declaration.h"

namespace stride::core {

/// "2 × 'n'"
std::string dimensions_text(std::span<const DimensionDeclaration> dimensions);

/// Nothing if a connector gives one of them.
std::optional<std::vector<Dimension>> known_sizes(std::span<const DimensionDeclaration> dimensions);

/// Whether the sizes are those declared, as far as these are known.
bool are_same(std::span<const DimensionDeclaration> declared, std::span<const std::size_t> sizes);

}  // namespace stride::core

#endif
