#include "master/model/finite.h"

#include <cstdlib>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "master/util/words.h"

namespace stride::core {
namespace {

/// Whether the nearest number of the type, which has fewer digits near 0, is another one.
template <class Real>
bool is_lost(long double exact, Real value) {
  constexpr long double kDeviation = 1e-3L;
  return exact != 0 && std::abs(exact) < std::numeric_limits<Real>::min() &&
         std::abs(exact - value) > kDeviation * std::abs(exact);
}

}  // namespace

std::optional<std::string> lost_number(const std::string& text, const ValueBlock& block,
                                       const LinearConversion& conversion) {
  if (!is_real(block.type())) return std::nullopt;
  const std::vector<std::string> words = words_of(text);
  for (std::size_t i = 0; i < words.size() && i < block.size(); ++i) {
    const long double exact =
        conversion.factor * std::strtold(words[i].c_str(), nullptr) + conversion.offset;
    const bool is_float = block.type() == ValueType::Float32;
    if (is_float ? !is_lost(exact, block.numbers<float>()[i])
                 : !is_lost(exact, block.numbers<double>()[i])) {
      continue;
    }
    return fmt::format("{} becomes {}: {} has no such number so near to 0", words[i],
                       element_text(block, i), name(block.type()));
  }
  return std::nullopt;
}

}  // namespace stride::core
