// Floating-point numbers that are not what is meant: infinite, NaN, or too near to 0.
#ifndef STRIDE_MASTER_ENGINE_MODEL_FINITE_H
#define STRIDE_MASTER_ENGINE_MODEL_FINITE_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "master/engine/model/values.h"

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

/// As parse(), converted: a Float32 is rounded once, behind the conversion. Throws
/// std::invalid_argument for what it cannot hold, too.
ValueBlock parse_converted(const Variable& variable, const std::string& text,
                           const LinearConversion& conversion);

/// The first number of a text that has lost its digits in this value, which it became by a
/// conversion: what has happened to it, "1e-400 becomes 0: …".
std::optional<std::string> lost_number(const std::string& text, const ValueBlock& block,
                                       const LinearConversion& conversion = {});

}  // namespace stride::core

#endif
