#ifndef STRIDE_UNITS_PLAYER_VALUES_H
#define STRIDE_UNITS_PLAYER_VALUES_H

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <stride/value_type.h>

namespace player {

using stride::Type;

/// Values of one type, in the order of Type; an Enumeration has those of Int64, a Clock has none.
using Values =
    std::variant<std::vector<float>, std::vector<double>, std::vector<std::int8_t>,
                 std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
                 std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<std::int64_t>,
                 std::vector<std::uint64_t>, std::vector<bool>, std::vector<std::string>,
                 std::vector<stride::Binary>>;

/// The type of this name ("Float64"); throws std::invalid_argument that lists them all.
Type type_named(const std::string& name);

/// No values yet, of this type.
Values values_of(Type type);

/// Reads one value and adds it. Throws std::invalid_argument that contains what was expected.
void append_parsed(Values& values, Type type, const std::string& text);

}  // namespace player

#endif
