// What a process that is not trusted may have sent in place of a value.
#ifndef STRIDE_MASTER_LOADER_WIRE_UNTRUSTED_VALUES_H
#define STRIDE_MASTER_LOADER_WIRE_UNTRUSTED_VALUES_H

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <stride/time.h>

#include "master/engine/model/values.h"
#include "master/engine/port/unit.h"

namespace stride::isolation {

/// Whether its elements have one size in memory: all but String and Binary.
constexpr bool has_fixed_size(core::ValueType type) {
  return type != core::ValueType::String && type != core::ValueType::Binary;
}

/// Of all elements, if they have a fixed size; else 0.
inline std::size_t byte_count(const core::ValueBlock& values) {
  return values.size() * core::element_size(values.type());
}

/// To be called when bytes were copied into the block: a bool of another byte than 0 and 1 has no
/// value in C++.
inline void make_true_or_false(core::ValueBlock& values) {
  if (values.type() != core::ValueType::Boolean && values.type() != core::ValueType::Clock) return;
  std::byte* const bytes = values.bytes();
  std::transform(bytes, bytes + byte_count(values), bytes,
                 [](std::byte byte) { return std::byte{byte != std::byte{0}}; });
}

/// Whether a step of this interval can have ended so.
inline bool is_possible(const core::StepResult& result, const core::StepInterval& interval) {
  return result.rejected || (result.reached >= interval.from && result.reached <= interval.to);
}

/// No unit can give a later next event, and with these a sum does not overflow.
inline bool is_possible(const core::EventResult& result) {
  return std::abs(to_seconds(result.next_event_time.value_or(Time{}))) <= kMaxSeconds + 1;
}

}  // namespace stride::isolation

#endif
