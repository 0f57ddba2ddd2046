#include "master/engine/model/system/declared_dimensions.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::core {

std::string dimensions_text(std::span<const DimensionDeclaration> dimensions) {
  std::vector<std::string> texts;
  for (const auto& [size, connector] : dimensions) {
    texts.push_back(size ? std::to_string(*size) : fmt::format("'{}'", connector));
  }
  return fmt::format("{}", fmt::join(texts, " × "));
}

std::optional<std::vector<Dimension>> known_sizes(
    std::span<const DimensionDeclaration> dimensions) {
  std::vector<Dimension> sizes;
  for (const DimensionDeclaration& dimension : dimensions) {
    if (!dimension.size) return std::nullopt;
    sizes.emplace_back(*dimension.size);
  }
  return sizes;
}

bool are_same(std::span<const DimensionDeclaration> declared, std::span<const std::size_t> sizes) {
  return std::ranges::equal(declared, sizes,
                            [](const DimensionDeclaration& dimension, std::size_t size) {
                              return !dimension.size || *dimension.size == size;
                            });
}

}  // namespace stride::core
