// The variables of a program, whose types are known when its declaration is read.
#ifndef STRIDE_UNITS_PROCESS_VARIABLE_H
#define STRIDE_UNITS_PROCESS_VARIABLE_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <valarray>
#include <variant>
#include <vector>

#include <stride/process/tag.h>
#include <stride/process/value.h>
#include <stride/value_type.h>

namespace process {

using stride::process::Binary;

using Value = std::variant<
    float, double, std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
    std::uint32_t, std::int64_t, std::uint64_t, bool, std::string, Binary,
    // arrays: unlike std::vector, they have real elements of bool
    std::valarray<float>, std::valarray<double>, std::valarray<std::int8_t>,
    std::valarray<std::uint8_t>, std::valarray<std::int16_t>, std::valarray<std::uint16_t>,
    std::valarray<std::int32_t>, std::valarray<std::uint32_t>, std::valarray<std::int64_t>,
    std::valarray<std::uint64_t>, std::valarray<bool>>;

/// The zero, false or empty value of the type with this name ("Float64"), or an array of so many;
/// throws std::invalid_argument that lists all types, or says which ones an array may have.
Value value_of_type(std::string_view type, const std::vector<std::size_t>& dimensions = {});
/// That of its elements, if it is an array.
stride::Type type_of(const Value& value);

/// Reads a value of the type that is there. Throws std::invalid_argument as parse_value() does.
void parse(std::string_view text, Value& value);
/// Adds an attribute to a tag, as text.
void write(stride::process::TagWriter& tag, std::string_view attribute, const Value& value);
bool is_same(const Value& one, const Value& other);

enum class Role : std::uint8_t { Parameter, Input, Output, MessageInput, MessageOutput };

struct Variable {
  std::string name;
  Role role = Role::Input;
  Value start;
  std::vector<std::size_t> dimensions;  ///< empty for a scalar
  std::string description;
  std::string unit;
  bool is_relative = false;
  std::string mime_type;
  std::string clock;  ///< the name of the clock of a message
  bool is_discrete = false;
  std::optional<double> min;
  std::optional<double> max;
  std::optional<std::vector<std::string>> depends_on;  ///< of an output: nothing = all inputs
};

}  // namespace process

#endif
