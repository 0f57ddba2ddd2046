#include "master/study/campaign/definition/decimal.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "master/base/message_text.h"

namespace stride::campaign {
namespace {

constexpr std::size_t kMostDigits = 18;
constexpr int kMostExponent = 400;

[[noreturn]] void reject_decimal(std::string_view text, const char* reason) {
  throw std::invalid_argument(
      fmt::format("'{}' {}; expected one such as 0.25 or 1e-3", core::name_text(text), reason));
}

/// Removes the exponent from the text.
int take_decimal_exponent(std::string_view& number, std::string_view text) {
  const std::size_t sign = number.find_first_of("eE");
  if (sign == number.npos) return 0;
  std::string_view digits = number.substr(sign + 1);
  number = number.substr(0, sign);
  if (digits.starts_with('+')) {
    digits.remove_prefix(1);
    if (digits.starts_with('-')) reject_decimal(text, "is not a number");
  }
  int exponent = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  if (error != std::errc() || end != digits.data() + digits.size() || digits.empty()) {
    reject_decimal(text, "is not a number");
  }
  if (std::abs(exponent) > kMostExponent) reject_decimal(text, "is out of range");
  return exponent;
}

/// The coefficient with this exponent, which is not above its own; nothing where it is too large.
std::optional<std::int64_t> scaled(Decimal number, int exponent) {
  std::int64_t value = number.coefficient;
  if (value == 0) return 0;
  for (int i = exponent; i < number.exponent; ++i) {
    if (__builtin_mul_overflow(value, std::int64_t{10}, &value)) return std::nullopt;
  }
  return value;
}

int lower_exponent(Decimal a, Decimal b) {
  if (a.coefficient == 0) return b.exponent;
  return b.coefficient == 0 ? a.exponent : std::min(a.exponent, b.exponent);
}

}  // namespace

Decimal parse_decimal(std::string_view text) {
  std::string_view number = text;
  const bool is_negative = number.starts_with('-');
  if (is_negative || number.starts_with('+')) number.remove_prefix(1);
  Decimal decimal;
  decimal.exponent = take_decimal_exponent(number, text);
  std::string digits;
  bool is_fraction = false;
  for (const char c : number) {
    if (c == '.' && !is_fraction) {
      is_fraction = true;
      continue;
    }
    if (c < '0' || c > '9') reject_decimal(text, "is not a number");
    digits += c;
    if (is_fraction) --decimal.exponent;
  }
  if (digits.empty()) reject_decimal(text, "is not a number");
  while (digits.size() > 1 && digits.back() == '0') {
    digits.pop_back();
    ++decimal.exponent;
  }
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  if (digits.size() > kMostDigits) reject_decimal(text, "has more than 18 digits");
  std::from_chars(digits.data(), digits.data() + digits.size(), decimal.coefficient);
  if (decimal.coefficient == 0) return {};
  if (is_negative) decimal.coefficient = -decimal.coefficient;
  return decimal;
}

std::optional<std::uint64_t> count_steps(Decimal first, Decimal step, Decimal last) {
  const int exponent = std::min(lower_exponent(first, step), lower_exponent(last, step));
  const auto a = scaled(first, exponent), s = scaled(step, exponent), b = scaled(last, exponent);
  std::int64_t distance = 0;
  if (!a || !s || !b || __builtin_sub_overflow(*b, *a, &distance)) return std::nullopt;
  return static_cast<std::uint64_t>(distance / *s) + 1;
}

std::string step_text(Decimal first, Decimal step, std::uint64_t index) {
  int exponent = lower_exponent(first, step);
  const auto a = scaled(first, exponent), s = scaled(step, exponent);
  std::int64_t value = *a + static_cast<std::int64_t>(index) * *s;
  if (value == 0) return "0";
  while (value % 10 == 0) {
    value /= 10;
    ++exponent;
  }
  const char* const sign = value < 0 ? "-" : "";
  std::string digits = std::to_string(value < 0 ? -value : value);
  const int point = static_cast<int>(digits.size()) + exponent;  // digits before the point
  constexpr int kMostPlain = 16;
  if (point > kMostPlain || point < -4) {
    if (digits.size() > 1) digits.insert(1, ".");
    return fmt::format("{}{}e{:+03d}", sign, digits, point - 1);
  }
  if (exponent >= 0) return sign + digits + std::string(static_cast<std::size_t>(exponent), '0');
  if (point > 0) return sign + digits.insert(static_cast<std::size_t>(point), ".");
  return fmt::format("{}0.{}{}", sign, std::string(static_cast<std::size_t>(-point), '0'), digits);
}

}  // namespace stride::campaign
