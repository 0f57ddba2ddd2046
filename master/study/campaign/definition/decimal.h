// Decimal numbers as they are written, so that 0.1 and two steps of 0.1 are 0.3.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DECIMAL_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DECIMAL_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stride::campaign {

/// coefficient * 10^exponent
struct Decimal {
  std::int64_t coefficient = 0;
  int exponent = 0;
};

/// Takes a text such as "-0.25" or "1e-3". Throws std::invalid_argument whose text contains what
/// was expected, also for more than 18 digits.
Decimal parse_decimal(std::string_view text);

/// How many of first, first + step, … are at most `last`; step is above 0, and `last` not below
/// first. Nothing where the numbers differ too much in magnitude.
std::optional<std::uint64_t> count_steps(Decimal first, Decimal step, Decimal last);

/// first + index * step for an index below that count, exactly: "0.3", "-12", "1e+20".
std::string step_text(Decimal first, Decimal step, std::uint64_t index);

}  // namespace stride::campaign

#endif
