#include "master/base/time_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <stride/time_text.h>

#include "master/base/message_text.h"

namespace stride::core {

std::string to_text(Time time) { return to_text(time.time_since_epoch()); }

std::string to_text(Duration duration) { return decimal_seconds(duration); }

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr int kDecimals = 12;

constexpr const char* kTooSmall = "is not 0 s and less than 1 ps, the resolution of times";

/// 0.DIGITS * 10^point, without leading or trailing zeros: no digits is zero.
struct Decimal {
  bool is_negative = false;
  std::string digits;
  std::int64_t point = 0;
};

/// "; write 0.002" for "2 ms", and "; write 0.5" for "0,5"; empty for other texts.
std::string meant_seconds(std::string_view text) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"", 1},      {"s", 1},      {"sec", 1},  {"ms", 1e-3}, {"us", 1e-6},
      {"ns", 1e-9}, {"ps", 1e-12}, {"min", 60}, {"h", 3600}};
  std::string plain(text);
  std::ranges::replace(plain, ',', '.');
  const char* const last = plain.data() + plain.size();
  double number = 0;
  const auto [end, error] = std::from_chars(plain.data(), last, number);
  const bool is_number_alone = end == last && plain == text;
  if (error != std::errc() || !std::isfinite(number) || is_number_alone) return "";
  std::string_view unit(end, static_cast<std::size_t>(last - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(kBlanks), unit.size()));
  for (const auto& [name, factor] : kUnits) {
    if (unit == name) return fmt::format("; write {:.12g}", number * factor);
  }
  return "";
}

[[noreturn]] void reject(std::string_view text, const char* reason) {
  throw std::invalid_argument(
      fmt::format("'{}' {}; expected a number of seconds such as 0.001 or 1e-3{}", name_text(text),
                  reason, meant_seconds(text)));
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view take_digits(std::string_view& rest) {
  const std::size_t count = std::min(rest.find_first_not_of("0123456789"), rest.size());
  const std::string_view digits = rest.substr(0, count);
  rest.remove_prefix(count);
  return digits;
}

std::int64_t take_exponent(std::string_view& rest, std::string_view text) {
  if (rest.empty() || (rest.front() != 'e' && rest.front() != 'E')) return 0;
  rest.remove_prefix(1);
  const bool is_negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  const std::string_view digits = take_digits(rest);
  if (digits.empty()) reject(text, "is not a number");
  constexpr std::int64_t kBeyondAnyTime = 1'000'000'000;
  std::int64_t value = kBeyondAnyTime;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  value = std::min(value, kBeyondAnyTime);
  return is_negative ? -value : value;
}

Decimal parse_decimal(std::string_view text) {
  std::string_view rest = trim(text);
  Decimal decimal;
  decimal.is_negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  const std::string_view whole = take_digits(rest);
  std::string_view fraction;
  if (!rest.empty() && rest.front() == '.') {
    rest.remove_prefix(1);
    fraction = take_digits(rest);
  }
  if (whole.empty() && fraction.empty()) reject(text, "is not a number");
  decimal.point = static_cast<std::int64_t>(whole.size()) + take_exponent(rest, text);
  if (!rest.empty()) reject(text, "is not a number");

  decimal.digits = fmt::format("{}{}", whole, fraction);
  const std::size_t zeros = std::min(decimal.digits.find_first_not_of('0'), decimal.digits.size());
  decimal.digits.erase(0, zeros);
  decimal.point -= static_cast<std::int64_t>(zeros);
  decimal.digits.erase(decimal.digits.find_last_not_of('0') + 1);
  return decimal;
}

/// What nearly all times are: few digits, a point, and twelve more at most.
std::optional<Duration> parse_plain(std::string_view text) {
  constexpr std::size_t kMostWhole = 6;
  std::string_view rest = text;
  const std::string_view whole = take_digits(rest);
  if (whole.empty() || whole.size() > kMostWhole) return std::nullopt;
  std::int64_t count = 0;
  for (const char digit : whole) count = 10 * count + (digit - '0');
  int decimals = 0;
  if (!rest.empty() && rest.front() == '.') {
    rest.remove_prefix(1);
    const std::string_view fraction = take_digits(rest);
    if (fraction.size() > kDecimals) return std::nullopt;
    for (const char digit : fraction) count = 10 * count + (digit - '0');
    decimals = static_cast<int>(fraction.size());
  }
  if (!rest.empty()) return std::nullopt;
  for (; decimals < kDecimals; ++decimals) count *= 10;
  return Duration(count);
}

/// Without the sign.
Duration magnitude(const Decimal& decimal, std::string_view text) {
  if (decimal.digits.empty()) return Duration::zero();
  const std::int64_t kept = decimal.point + kDecimals;  // digits left of the picosecond's end
  constexpr std::int64_t kMostDigits = 28;              // of kMaxSeconds
  if (kept > kMostDigits) reject(text, "is beyond 1e15 s, the largest time");
  if (kept < 0) reject(text, kTooSmall);
  std::string digits = decimal.digits.substr(0, static_cast<std::size_t>(kept));
  const bool round_up =
      digits.size() < decimal.digits.size() && decimal.digits[digits.size()] >= '5';
  digits.resize(static_cast<std::size_t>(kept), '0');

  Picoseconds count = 0;
  for (const char digit : digits) count = 10 * count + (digit - '0');
  const Duration duration(count + (round_up ? 1 : 0));
  if (duration == Duration::zero()) reject(text, kTooSmall);
  if (duration > std::chrono::seconds(static_cast<std::int64_t>(kMaxSeconds))) {
    reject(text, "is beyond 1e15 s, the largest time");
  }
  return duration;
}

}  // namespace

Duration parse_seconds(std::string_view text) {
  if (const auto plain = parse_plain(text)) return *plain;
  const Decimal decimal = parse_decimal(text);
  if (decimal.is_negative && !decimal.digits.empty()) reject(text, "is negative");
  return magnitude(decimal, text);
}

Time parse_time(std::string_view text) {
  if (const auto plain = parse_plain(text)) return Time(*plain);
  const Decimal decimal = parse_decimal(text);
  const Duration since = magnitude(decimal, text);
  return Time(decimal.is_negative ? -since : since);
}

std::string wall_seconds(std::chrono::nanoseconds time) {
  return fmt::format("{:.3f}", std::chrono::duration<double>(time).count());
}

}  // namespace stride::core
