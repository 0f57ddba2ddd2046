#include "master/base/text/number_text.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

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

bool is_tiny_number(std::string_view text) {
  constexpr double kAnyBetween = 1;
  return std::abs(std::strtod(std::string(text).c_str(), nullptr)) < kAnyBetween;
}

}  // namespace stride::core
