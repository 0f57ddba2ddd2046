// How far one number is from another.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_DIFFERENCE_H
#define STRIDE_MASTER_OBSERVE_CHECKS_DIFFERENCE_H

#include <cstdint>
#include <type_traits>

namespace stride::checks {

/// a - b, whose sign is exact: the difference of integers is taken as a whole number.
template <class T>
double difference(T a, T b) {
  if constexpr (std::is_integral_v<T>) {
    const auto distance = [](T more, T less) {
      return static_cast<double>(static_cast<std::uint64_t>(more) -
                                 static_cast<std::uint64_t>(less));
    };
    return a >= b ? distance(a, b) : -distance(b, a);
  } else {
    return static_cast<double>(a) - static_cast<double>(b);
  }
}

}  // namespace stride::checks

#endif
