#include "master/front/cli/campaign/cluster/slurm_time.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <system_error>
#include <vector>

#include "master/base/text/lower_case.h"

namespace stride::cli {
namespace {

/// The numbers between colons; nothing if there is another text, or more than three.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (bool has_more = true; has_more;) {
    const std::size_t end = std::min(text.find(':'), text.size());
    unsigned number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc() || rest != text.data() + end || numbers.size() == 3) return {};
    numbers.push_back(number);
    has_more = end < text.size();
    text.remove_prefix(has_more ? end + 1 : end);
  }
  return numbers;
}

}  // namespace

std::optional<double> slurm_seconds(const std::string& time) {
  const std::string word = core::lower_case(time);
  if (word == "unlimited" || word == "infinite") return std::numeric_limits<double>::infinity();
  constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
  const std::size_t dash = time.find('-');
  if (dash == std::string::npos) {
    const auto numbers = numbers_of(time);
    if (!numbers) return std::nullopt;
    if (numbers->size() == 3)
      return (*numbers)[0] * kHour + (*numbers)[1] * kMinute + (*numbers)[2];
    return (*numbers)[0] * kMinute + (numbers->size() == 2 ? (*numbers)[1] : 0);
  }
  const auto days = numbers_of(std::string_view(time).substr(0, dash));
  const auto rest = numbers_of(std::string_view(time).substr(dash + 1));
  if (!days || !rest || days->size() != 1) return std::nullopt;
  double seconds = (*days)[0] * kDay, unit = kHour;
  for (const double number : *rest) {
    seconds += number * unit;
    unit /= 60;
  }
  return seconds;
}

}  // namespace stride::cli
