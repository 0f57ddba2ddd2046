// Floating-point numbers that are no numbers.
#ifndef STRIDE_MASTER_MODEL_FINITE_H
#define STRIDE_MASTER_MODEL_FINITE_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "master/model/values.h"

namespace stride::core {

/// The text of the first element that is NaN or infinite.
inline std::optional<std::string> not_finite(const ValueBlock& block) {
  return visit(block, [&]<class T>(std::span<const T> values) -> std::optional<std::string> {
    if constexpr (std::is_floating_point_v<T>) {
      const auto found = std::ranges::find_if_not(values, [](T v) { return std::isfinite(v); });
      if (found != values.end()) {
        return element_text(block, static_cast<std::size_t>(found - values.begin()));
      }
    }
    return std::nullopt;
  });
}

}  // namespace stride::core

#endif
