// The C++ types of values.
#ifndef STRIDE_MASTER_ENGINE_MODEL_VISIT_TYPE_H
#define STRIDE_MASTER_ENGINE_MODEL_VISIT_TYPE_H

#include <cstdint>
#include <string>
#include <type_traits>

#include "master/engine/model/description.h"

namespace stride::core {

/// Calls visitor(std::type_identity<T>()) with the C++ type of a value: bool for Boolean and Clock,
/// std::int64_t for Enumeration, std::string and Binary for String and Binary.
template <class Visitor>
decltype(auto) visit_type(ValueType type, Visitor&& visitor) {
  switch (type) {
    case ValueType::Float32:
      return visitor(std::type_identity<float>());
    case ValueType::Float64:
      return visitor(std::type_identity<double>());
    case ValueType::Int8:
      return visitor(std::type_identity<std::int8_t>());
    case ValueType::UInt8:
      return visitor(std::type_identity<std::uint8_t>());
    case ValueType::Int16:
      return visitor(std::type_identity<std::int16_t>());
    case ValueType::UInt16:
      return visitor(std::type_identity<std::uint16_t>());
    case ValueType::Int32:
      return visitor(std::type_identity<std::int32_t>());
    case ValueType::UInt32:
      return visitor(std::type_identity<std::uint32_t>());
    case ValueType::Int64:
    case ValueType::Enumeration:
      return visitor(std::type_identity<std::int64_t>());
    case ValueType::UInt64:
      return visitor(std::type_identity<std::uint64_t>());
    case ValueType::Boolean:
    case ValueType::Clock:
      return visitor(std::type_identity<bool>());
    case ValueType::String:
      return visitor(std::type_identity<std::string>());
    case ValueType::Binary:
      break;
  }
  return visitor(std::type_identity<Binary>());
}

}  // namespace stride::core

#endif
