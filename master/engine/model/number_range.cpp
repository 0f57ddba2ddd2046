#include "master/engine/model/number_range.h"

#include <limits>
#include <type_traits>

#include "master/engine/model/visit_type.h"

namespace stride::core {
namespace {

template <class T>
constexpr NumberRange limits_of() {
  using Limits = std::numeric_limits<T>;
  return {static_cast<std::int64_t>(Limits::min()), static_cast<std::uint64_t>(Limits::max())};
}

}  // namespace

std::optional<NumberRange> range_of(ValueType type) {
  return visit_type(type, []<class T>(std::type_identity<T>) -> std::optional<NumberRange> {
    if constexpr (std::is_floating_point_v<T>) {
      constexpr auto kMost = std::int64_t{1} << std::numeric_limits<T>::digits;
      return NumberRange{-kMost, kMost};
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      return limits_of<T>();
    } else {
      return std::nullopt;
    }
  });
}

}  // namespace stride::core
