#include "master/engine/model/finite.h"

#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/text/words.h"

namespace stride::core {
namespace {

/// Whether the type has fewer digits there than elsewhere, or none.
bool is_near_zero(long double number, ValueType type) {
  const long double least = type == ValueType::Float32 ? std::numeric_limits<float>::min()
                                                       : std::numeric_limits<double>::min();
  return number != 0 && std::abs(number) < least;
}

bool are_near(long double number, long double other) {
  constexpr long double kDeviation = 1e-3L;
  return std::abs(number - other) <= kDeviation * std::abs(number);
}

/// A whole number that an Int64 or a UInt64 can have.
bool is_integer_text(const std::string& word) {
  constexpr std::size_t kMostDigits = 19;
  const std::size_t sign = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
  const bool has_digits = word.size() > sign && word.size() - sign <= kMostDigits;
  return has_digits && word.find_first_not_of("0123456789", sign) == std::string::npos;
}

}  // namespace

ValueBlock parse_converted(const Variable& variable, const std::string& text,
                           const LinearConversion& conversion) {
  if (variable.type != ValueType::Float32 || conversion.is_identity()) {
    ValueBlock value = parse(variable, text);
    convert(value, conversion);
    return value;
  }
  Variable wide = variable;
  wide.type = ValueType::Float64;
  ValueBlock exact = parse(wide, text);
  ValueBlock value(variable.type, variable.size);
  convert(exact, conversion);
  copy_elements(value, 0, exact, 0, variable.size);
  for (std::size_t i = 0; i < variable.size; ++i) {
    if (std::isfinite(real(exact, i)) == std::isfinite(real(value, i))) continue;
    throw std::invalid_argument(
        fmt::format("'{}' is {} in the variable's unit of measure, expected a number within the "
                    "range of Float32",
                    name_text(text), real(exact, i)));
  }
  return value;
}

std::optional<std::string> lost_number(const std::string& text, const ValueBlock& block,
                                       const LinearConversion& conversion) {
  if (!is_real(block.type())) return std::nullopt;
  const std::vector<std::string> words = words_of(text);
  for (std::size_t i = 0; i < words.size() && i < block.size(); ++i) {
    const long double exact =
        conversion.factor * std::strtold(words[i].c_str(), nullptr) + conversion.offset;
    const bool is_whole = conversion.is_identity() && is_integer_text(words[i]);
    if (is_whole && exact != static_cast<long double>(real(block, i))) {
      return fmt::format("{} becomes {:.0f}: {} has fewer digits", words[i], real(block, i),
                         name(block.type()));
    }
    if (!is_near_zero(exact, block.type())) continue;
    const std::string value = element_text(block, i);  // the shortest text that stands for it
    if (are_near(exact, real(block, i)) || are_near(exact, std::strtold(value.c_str(), nullptr))) {
      continue;
    }
    return fmt::format("{} becomes {}: {} has no such number so near to 0", words[i], value,
                       name(block.type()));
  }
  return std::nullopt;
}

}  // namespace stride::core
