#include "master/util/number_text.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace stride::core {
namespace {

std::optional<double> finite_number(std::string_view text) {
  double value = 0;
  const auto [end, mistake] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = mistake == std::errc() && end == text.data() + text.size();
  return is_number && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

double parse_at_least_zero(std::string_view text) {
  const std::optional<double> value = finite_number(text);
  if (value && *value >= 0) return *value;
  throw std::invalid_argument(fmt::format("'{}' is not a number of at least 0", text));
}

double parse_above_zero(std::string_view text) {
  const std::optional<double> value = finite_number(text);
  if (value && *value > 0) return *value;
  throw std::invalid_argument(fmt::format("'{}' is not a number above 0", text));
}

}  // namespace stride::core
