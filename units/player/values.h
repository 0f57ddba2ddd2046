#ifndef STRIDE_UNITS_PLAYER_VALUES_H
#define STRIDE_UNITS_PLAYER_VALUES_H

#include <cstdint>
#include <string>
#include <string_view>
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

/// Without the blanks around it.
std::string trimmed(std::string_view text);

/// A value as a person or a spreadsheet writes it, in the form that append_parsed() reads: without
/// blanks around it, "+1" as 1, of a whole number "2.0" as 2, of a Boolean "True" as true and "0"
/// as false. A String, and what is no such value, is returned as it is.
std::string plain_value(Type type, const std::string& text);

/// Reads one value and adds it. Throws std::invalid_argument that contains what was expected.
void append_parsed(Values& values, Type type, const std::string& text);

}  // namespace player

#endif
