#include "master/engine/model/finite.h"

#include <cstdlib>
#include <limits>
#include <vector>

#include <fmt/format.h>

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

}  // namespace

std::optional<std::string> lost_number(const std::string& text, const ValueBlock& block,
                                       const LinearConversion& conversion) {
  if (!is_real(block.type())) return std::nullopt;
  const std::vector<std::string> words = words_of(text);
  for (std::size_t i = 0; i < words.size() && i < block.size(); ++i) {
    const long double exact =
        conversion.factor * std::strtold(words[i].c_str(), nullptr) + conversion.offset;
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
