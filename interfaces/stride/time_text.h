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

/// The time of digits with at most twelve decimals, such as "-0.5" or "14.200358702064"; nothing
/// for any other text, or beyond kMaxSeconds.
inline std::optional<Time> time_of_decimal(std::string_view text) {
  constexpr std::size_t kDecimals = 12;
  constexpr std::size_t kMostWhole = 16;  // of kMaxSeconds
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
  Picoseconds count = 0;
  for (const std::string_view digits : {whole, decimals}) {
    for (const char digit : digits) {
      if (digit < '0' || digit > '9') return std::nullopt;
      count = 10 * count + (digit - '0');
    }
  }
  for (std::size_t i = decimals.size(); i < kDecimals; ++i) count *= 10;
  const Time time(Duration(is_negative ? -count : count));
  return count <= static_cast<Picoseconds>(kMaxSeconds) * detail::kPicosecondsPerSecond
             ? std::optional(time)
             : std::nullopt;
}

}  // namespace stride

#endif
