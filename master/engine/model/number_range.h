// The whole numbers that a type has.
#ifndef STRIDE_MASTER_ENGINE_MODEL_NUMBER_RANGE_H
#define STRIDE_MASTER_ENGINE_MODEL_NUMBER_RANGE_H

#include <cstdint>
#include <optional>

#include "master/engine/model/description.h"

namespace stride::core {

struct NumberRange {
  std::int64_t least;
  std::uint64_t most;

  bool holds(const NumberRange& other) const { return least <= other.least && most >= other.most; }
  bool holds(std::int64_t number) const {
    return number >= least && (number < 0 || static_cast<std::uint64_t>(number) <= most);
  }
};

/// Of Float32 and Float64: the numbers up to which all whole numbers are exact. Nothing for Boolean
/// and for what is no number.
std::optional<NumberRange> range_of(ValueType type);

/// Enumeration is one, too.
inline bool is_integer(ValueType type) { return range_of(type) && !is_real(type); }

/// Whether its values have an order: all numbers but Enumeration.
inline bool is_number(ValueType type) {
  return range_of(type).has_value() && type != ValueType::Enumeration;
}

}  // namespace stride::core

#endif
