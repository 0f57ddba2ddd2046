#ifndef STRIDE_UNITS_PLAYER_VALUES_H
#define STRIDE_UNITS_PLAYER_VALUES_H

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace player {

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

using Bytes = std::vector<std::uint8_t>;

/// Values of one type; an Enumeration has those of Int64, a Clock has none.
using Values =
    std::variant<std::vector<float>, std::vector<double>, std::vector<std::int8_t>,
                 std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
                 std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<std::int64_t>,
                 std::vector<std::uint64_t>, std::vector<bool>, std::vector<std::string>,
                 std::vector<Bytes>>;

/// The type of this name ("Float64"); throws std::invalid_argument that lists them all.
Type type_named(const std::string& name);
const char* name(Type type);

/// No values yet, of this type.
Values values_of(Type type);

/// Reads one value and adds it. Throws std::invalid_argument that says what was expected.
void append_parsed(Values& values, Type type, const std::string& text);
/// Adds 0, false or an empty text.
void append_default(Values& values);

}  // namespace player

#endif
