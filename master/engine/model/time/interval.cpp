#include "master/engine/model/time/interval.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"

namespace stride::core {
namespace {

__extension__ using Wide = unsigned __int128;

constexpr std::uint64_t kPicoseconds = 1'000'000'000'000;
/// So that the sum of two fractions of different denominators fits into 128 bits.
constexpr std::uint64_t kMaxDenominator = std::uint64_t{1} << 62;
constexpr int kMaxDecimals = 18;  // 10^18 < 2^62
/// [ps] The sum of a few of them has room in 128 bits.
constexpr Wide kMost = Wide{static_cast<std::uint64_t>(kMaxSeconds)} * kPicoseconds;
constexpr Time kLatest = Time(Duration(static_cast<Picoseconds>(kMost)));

Wide greatest_common_divisor(Wide a, Wide b) {
  while (b != 0) {
    const Wide rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

Wide power_of_ten(int exponent) {
  Wide power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// A rounded fraction of less digits may as well be the decimal that it is written as.
constexpr std::uint64_t kLeastMeantFraction = 100'000'000'000'000;  // of 15 digits

struct Fraction {
  std::uint64_t numerator, denominator;
};

/// The first convergent of the continued fraction of this positive number that is the same within
/// two units of its last place; nothing if it is as complicated as a number that was not rounded
/// would have by chance.
std::optional<Fraction> meant_fraction(double value) {
  constexpr double kMostComplicated = 1e11;  // a chance of 1e-4 or so
  const double tolerance = 2 * std::numeric_limits<double>::epsilon() * value;
  Fraction before{0, 1};
  Fraction last{1, 0};
  double rest = value;
  while (rest < kMostComplicated) {
    const auto digit = static_cast<std::uint64_t>(rest);
    const Fraction next{digit * last.numerator + before.numerator,
                        digit * last.denominator + before.denominator};
    const auto numerator = static_cast<double>(next.numerator);
    const auto denominator = static_cast<double>(next.denominator);
    if (numerator * denominator > kMostComplicated) return std::nullopt;
    if (std::abs(numerator / denominator - value) <= tolerance) return next;
    before = std::exchange(last, next);
    rest = 1 / (rest - static_cast<double>(digit));
  }
  return std::nullopt;
}

/// digits * 10^exponent
struct Decimal {
  std::uint64_t digits;
  int exponent;
};

/// The shortest decimal that reads back as this positive number: at most 17 digits.
Decimal shortest_decimal(double value) {
  char text[32];
  const auto end =
      std::to_chars(std::begin(text), std::end(text), value, std::chars_format::scientific);
  const std::string_view all(text, static_cast<std::size_t>(end.ptr - text));
  const std::size_t e = all.find('e');
  std::string mantissa(all.substr(0, e));
  int decimals = 0;
  if (const std::size_t point = mantissa.find('.'); point != std::string::npos) {
    decimals = static_cast<int>(mantissa.size() - point - 1);
    mantissa.erase(point, 1);
  }
  std::string_view power = all.substr(e + 1);
  if (power.front() == '+') power.remove_prefix(1);
  Decimal decimal{};
  std::from_chars(mantissa.data(), mantissa.data() + mantissa.size(), decimal.digits);
  std::from_chars(power.data(), power.data() + power.size(), decimal.exponent);
  decimal.exponent -= decimals;
  return decimal;
}

}  // namespace

Interval::Interval(Wide numerator, std::uint64_t denominator) {
  const Wide divisor = greatest_common_divisor(numerator, denominator);
  numerator_ = numerator / divisor;
  denominator_ = static_cast<std::uint64_t>(denominator / divisor);
}

Interval Interval::from_fraction(std::uint64_t counter, std::uint64_t resolution) {
  if (resolution == 0) throw std::invalid_argument("the resolution is 0");
  const Interval interval(Wide{counter} * kPicoseconds, resolution);
  if (interval.denominator_ > kMaxDenominator) {
    throw std::invalid_argument("the resolution " + std::to_string(resolution) +
                                " is finer than any clock's");
  }
  return interval;
}

Interval Interval::from_seconds(double seconds) {
  if (std::isnan(seconds)) throw std::invalid_argument("it is not a number");
  if (seconds < 0) throw std::invalid_argument("it is negative");
  if (seconds == 0) return {};
  auto [digits, exponent] = shortest_decimal(std::min(seconds, 2 * kMaxSeconds));
  if (digits >= kLeastMeantFraction) {
    if (const auto meant = meant_fraction(seconds)) {
      return from_fraction(meant->numerator, meant->denominator);
    }
  }
  exponent += 12;
  for (; exponent < -kMaxDecimals && digits != 0; ++exponent) digits /= 10;
  if (digits == 0) return {};
  if (exponent < 0) return {digits, static_cast<std::uint64_t>(power_of_ten(-exponent))};
  return {Wide{digits} * power_of_ten(exponent), 1};
}

Interval Interval::from_duration(Duration duration) {
  if (duration < Duration{}) throw std::invalid_argument("it is negative");
  return {static_cast<Wide>(duration.count()), 1};
}

Interval Interval::parse(std::string_view seconds) {
  parse_seconds(seconds);
  return from_seconds(xml::to_number<double>(xml::split(seconds).front()).value());
}

std::strong_ordering Interval::operator<=>(const Interval& other) const {
  const Wide whole = numerator_ / denominator_;
  const Wide other_whole = other.numerator_ / other.denominator_;
  if (whole != other_whole) return whole <=> other_whole;
  return numerator_ % denominator_ * other.denominator_ <=>
         other.numerator_ % other.denominator_ * denominator_;
}

bool Interval::is_multiple_of(const Interval& other) const {
  if (is_zero() || other.is_zero()) return is_zero();
  return numerator_ % other.numerator_ == 0 && other.denominator_ % denominator_ == 0;
}

Duration Interval::rounded() const {
  const auto time = tick_time(Time{}, {}, *this, 1);
  return time ? time->time_since_epoch() : Duration::max();
}

void Interval::persist(StateArchive& state) {
  auto low = static_cast<std::uint64_t>(numerator_);
  auto high = static_cast<std::uint64_t>(numerator_ >> 64);
  state.value(low);
  state.value(high);
  state.value(denominator_);
  numerator_ = Wide{high} << 64 | low;
  if (denominator_ == 0 || denominator_ > kMaxDenominator) state.fail("an interval is no fraction");
}

Interval::Ratio Interval::ratio() const {
  const Wide divisor = greatest_common_divisor(kPicoseconds, numerator_);
  return {static_cast<double>(numerator_ / divisor),
          static_cast<double>(denominator_ * (kPicoseconds / divisor))};
}

std::optional<Interval> sum(const Interval& shift, const Interval& interval, std::uint64_t count) {
  const std::uint64_t factor =
      interval.denominator_ / std::gcd(shift.denominator_, interval.denominator_);
  std::uint64_t denominator = 0;
  if (__builtin_mul_overflow(shift.denominator_, factor, &denominator)) return std::nullopt;
  Wide first = 0;
  Wide second = 0;
  Wide numerator = 0;
  const bool overflows =
      denominator > kMaxDenominator || __builtin_mul_overflow(shift.numerator_, factor, &first) ||
      __builtin_mul_overflow(interval.numerator_, count, &second) ||
      __builtin_mul_overflow(second, denominator / interval.denominator_, &second) ||
      __builtin_add_overflow(first, second, &numerator);
  return overflows ? std::nullopt : std::optional(Interval(numerator, denominator));
}

std::optional<Interval> common_multiple(const Interval& a, const Interval& b) {
  const Wide factor = b.numerator_ / greatest_common_divisor(a.numerator_, b.numerator_);
  if (factor > ~Wide{0} / a.numerator_) return std::nullopt;
  return Interval(a.numerator_ * factor, std::gcd(a.denominator_, b.denominator_));
}

std::string to_text(const Interval& interval) {
  return interval.is_whole() ? to_text(interval.rounded()) : fmt::format("{}", interval.seconds());
}

std::optional<Time> tick_time(Time base, const Interval& shift, const Interval& interval,
                              std::uint64_t count) {
  // whole picoseconds and what is left are repeated apart, so that no product is too wide
  const Wide fractions = count * (interval.numerator_ % interval.denominator_);
  const Wide rest = fractions % interval.denominator_;
  const Wide shift_rest = shift.numerator_ % shift.denominator_;
  // two fractions below 1, so that their rounded sum is 0, 1 or 2
  const Wide denominator = Wide{shift.denominator_} * interval.denominator_;
  const Wide sum = shift_rest * interval.denominator_ + rest * shift.denominator_;
  const Wide rounded = (2 * sum + denominator) / 2 / denominator;

  const Wide whole = interval.numerator_ / interval.denominator_;
  const Wide shift_whole = shift.numerator_ / shift.denominator_;
  if (shift_whole > kMost || (whole != 0 && count > kMost / whole)) return std::nullopt;
  const Wide duration = shift_whole + count * whole + fractions / interval.denominator_ + rounded;
  const Time time = base + Duration(static_cast<Picoseconds>(duration));
  return time <= kLatest ? std::optional(time) : std::nullopt;
}

}  // namespace stride::core
