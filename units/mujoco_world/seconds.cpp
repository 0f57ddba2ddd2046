#include "units/mujoco_world/seconds.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <system_error>

namespace mujoco_world {

std::string seconds_text(stride::Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  const std::int64_t second = stride::Duration(std::chrono::seconds(1)).count();
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%s%lld.%012lld", count < 0 ? "-" : "",
                static_cast<long long>(std::llabs(count / second)),
                static_cast<long long>(std::llabs(count % second)));
  std::string seconds = text.data();
  seconds.erase(seconds.find_last_not_of('0') + 1);
  if (seconds.back() == '.') seconds.pop_back();
  return seconds;
}

std::optional<stride::Time> time_of(const std::string& seconds) {
  constexpr std::size_t kDigits = 12;  // of a second
  const bool is_negative = !seconds.empty() && seconds.front() == '-';
  const std::size_t point = std::min(seconds.find('.'), seconds.size());
  std::string digits = seconds.substr(is_negative, point - is_negative);
  std::string fraction = point < seconds.size() ? seconds.substr(point + 1) : "";
  fraction.resize(kDigits, '0');
  digits += fraction;
  std::int64_t count = 0;
  const char* const end = digits.data() + digits.size();
  const auto [behind, error] = std::from_chars(digits.data(), end, count);
  const stride::Time time{stride::Duration(is_negative ? -count : count)};
  // what is written otherwise, or is longer than that, is none
  if (error != std::errc() || behind != end || seconds_text(time) != seconds) return std::nullopt;
  return time;
}

}  // namespace mujoco_world
