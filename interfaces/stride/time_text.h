// Times as decimal numbers of seconds, of which no digit is lost.
#ifndef STRIDE_TIME_TEXT_H
#define STRIDE_TIME_TEXT_H

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <stride/time.h>

namespace stride {

/// Without trailing zeros: "-0.000001", "12" and "0.1".
inline std::string decimal_seconds(Duration duration) {
  constexpr std::size_t kDecimals = 12;
  __extension__ using Magnitude = unsigned __int128;
  const bool is_negative = duration < Duration();
  auto rest = static_cast<Magnitude>(duration.count());
  if (is_negative) rest = 0 - rest;
  std::string text;
  for (; rest != 0 || text.size() <= kDecimals; rest /= 10) {
    text += static_cast<char>('0' + static_cast<int>(rest % 10));
  }
  if (is_negative) text += '-';
  std::reverse(text.begin(), text.end());
  text.insert(text.size() - kDecimals, ".");
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}
inline std::string decimal_seconds(Time time) { return decimal_seconds(time.time_since_epoch()); }

/// The time of a decimal number such as "-0.5" or "14.200358702064", which counts a unit of at most
/// a day; nothing for any other text, for what is no whole number of picoseconds, or beyond
/// kMaxSeconds.
inline std::optional<Time> time_of_decimal(std::string_view text,
                                           Duration unit = std::chrono::seconds(1)) {
  constexpr std::size_t kDecimals = 18;
  constexpr std::size_t kMostWhole = 16;
  const bool is_negative = !text.empty() && text.front() == '-';
  if (is_negative) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view decimals = text.substr(std::min(point + 1, text.size()));
  const bool has_fraction = point != text.size();
  if (whole.empty() || whole.size() > kMostWhole || decimals.size() > kDecimals ||
      decimals.empty() == has_fraction) {
    return std::nullopt;
  }
  Picoseconds units = 0;
  for (const char digit : whole) {
    if (digit < '0' || digit > '9') return std::nullopt;
    units = 10 * units + (digit - '0');
  }
  Picoseconds parts = 0;
  Picoseconds parts_of_unit = 1;
  for (const char digit : decimals) {
    if (digit < '0' || digit > '9') return std::nullopt;
    parts = 10 * parts + (digit - '0');
    parts_of_unit *= 10;
  }
  if (parts * unit.count() % parts_of_unit != 0) return std::nullopt;
  const Duration since = units * unit + Duration(parts * unit.count() / parts_of_unit);
  if (since > std::chrono::seconds(static_cast<std::int64_t>(kMaxSeconds))) return std::nullopt;
  return Time(is_negative ? -since : since);
}

}  // namespace stride

#endif
