// The types that a variable of FMI 3.0 has, and the types of C++ that hold its values.
#ifndef STRIDE_VALUE_TYPE_H
#define STRIDE_VALUE_TYPE_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace stride {

using Binary = std::vector<std::uint8_t>;

class Clock;

/// The types of FMI 3.0.
enum class Type : std::uint8_t {
  Float32,
  Float64,
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Boolean,
  String,
  Binary,
  Enumeration,
  Clock,
};

inline constexpr const char* kTypeNames[] = {
    "Float32", "Float64", "Int8",    "UInt8",  "Int16",  "UInt16",      "Int32", "UInt32",
    "Int64",   "UInt64",  "Boolean", "String", "Binary", "Enumeration", "Clock"};

/// The name that FMI has for a type: "Float64".
constexpr const char* type_name(Type type) { return kTypeNames[static_cast<std::size_t>(type)]; }

namespace detail {

/// The FMI type of a C++ type; any enum with the underlying type std::int64_t is an Enumeration.
template <class T>
constexpr Type type_of() {
  if constexpr (std::is_enum_v<T>) {
    static_assert(std::is_same_v<std::underlying_type_t<T>, std::int64_t>,
                  "an FMI enumeration needs 'enum class E : std::int64_t'");
    return Type::Enumeration;
  } else if constexpr (std::is_same_v<T, float>) {
    return Type::Float32;
  } else if constexpr (std::is_same_v<T, double>) {
    return Type::Float64;
  } else if constexpr (std::is_same_v<T, bool>) {
    return Type::Boolean;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return Type::String;
  } else if constexpr (std::is_same_v<T, Binary>) {
    return Type::Binary;
  } else if constexpr (std::is_same_v<T, Clock>) {
    return Type::Clock;
  } else {
    static_assert(std::is_integral_v<T>, "this type has no counterpart in FMI 3.0");
    constexpr Type kSigned[] = {Type::Int8, Type::Int16, Type::Int32, Type::Int64};
    constexpr Type kUnsigned[] = {Type::UInt8, Type::UInt16, Type::UInt32, Type::UInt64};
    constexpr int kLog2 = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return std::is_signed_v<T> ? kSigned[kLog2] : kUnsigned[kLog2];
  }
}

}  // namespace detail

/// The name that FMI has for a type of C++: float, double, the integers, bool, std::string, Binary.
template <class T>
constexpr const char* type_name() {
  return type_name(detail::type_of<T>());
}

}  // namespace stride

#endif
