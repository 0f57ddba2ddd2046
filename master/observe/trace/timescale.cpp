#include "master/observe/trace/timescale.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "master/base/message_text.h"

namespace stride::trace {
namespace {

/// Each a thousand times the one before, from 10^-15 s on.
constexpr std::array<std::string_view, 6> kUnits = {"fs", "ps", "ns", "us", "ms", "s"};
constexpr int kSmallest = -15;

std::string without_blanks(std::string_view text) {
  std::string word(text);
  std::erase_if(word, [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); });
  return word;
}

}  // namespace

Timescale Timescale::parse(std::string_view text) {
  const std::string word = without_blanks(text);
  const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
  const std::string number = word.substr(0, digits);
  const auto unit = std::find(kUnits.begin(), kUnits.end(), word.substr(digits));
  if ((number != "1" && number != "10" && number != "100") || unit == kUnits.end()) {
    throw std::invalid_argument(
        fmt::format("'{}' is not a time scale; expected 1, 10 or 100 of s, ms, us, ns, ps or fs",
                    core::name_text(word.substr(0, 20))));
  }
  return {kSmallest + 3 * static_cast<int>(unit - kUnits.begin()) +
          static_cast<int>(number.size()) - 1};
}

std::string Timescale::text() const {
  constexpr const char* kNumbers[] = {"1", "10", "100"};
  const int above = exponent - kSmallest;
  return fmt::format("{} {}", kNumbers[above % 3], kUnits[static_cast<std::size_t>(above / 3)]);
}

std::string Timescale::seconds(std::int64_t ticks) const {
  std::string digits = std::to_string(ticks);
  if (ticks == 0) return digits;
  if (exponent >= 0) return digits + std::string(static_cast<std::size_t>(exponent), '0');
  const auto decimals = static_cast<std::size_t>(-exponent);
  if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
  digits.insert(digits.size() - decimals, ".");
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::int64_t Timescale::ticks_in(Duration duration) const {
  constexpr Picoseconds kMost = std::numeric_limits<std::int64_t>::max();
  Picoseconds ticks = duration.count();
  for (int i = -12; i < exponent; ++i) ticks /= 10;
  for (int i = exponent; i < -12; ++i) ticks = std::min(ticks * 10, kMost);
  return static_cast<std::int64_t>(std::min(ticks, kMost));
}

}  // namespace stride::trace
