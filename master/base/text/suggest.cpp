#include "master/base/text/suggest.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "master/base/text/lower_case.h"

namespace stride::core {
namespace {

/// The edit distance (Levenshtein), or some number that is not below `limit` if it is not either.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t least = a.size() < b.size() ? b.size() - a.size() : a.size() - b.size();
  if (least >= limit) return least;
  while (!a.empty() && !b.empty() && a.front() == b.front()) {
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  while (!a.empty() && !b.empty() && a.back() == b.back()) {
    a.remove_suffix(1);
    b.remove_suffix(1);
  }
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
    const std::size_t lowest = *std::min_element(row.begin(), row.end());
    if (lowest >= limit) return lowest;  // the rows below have no smaller number
  }
  return row.back();
}

/// What the edit distance of a name has to be below. Parts that are the same, such as the component
/// in "sensor.led", do not make the others more alike.
std::size_t limit_of(const std::string& word, const std::string& candidate) {
  const auto differs = std::ranges::mismatch(word, candidate).in1;
  const std::string same(word.begin(), differs);
  const std::size_t size = word.size() - (same.rfind('.') + 1);  // npos + 1 is 0
  return std::max<std::size_t>(2, size / 3) + 1;
}

}  // namespace

std::string nearest(const std::string& word, std::span<const std::string> candidates) {
  const std::string lower = lower_case(word);
  for (const std::string& candidate : candidates) {
    if (candidate.size() == word.size() && lower_case(candidate) == lower) return candidate;
  }
  std::string best;
  std::size_t best_distance = std::string::npos;
  for (const std::string& candidate : candidates) {
    const std::size_t limit = std::min(best_distance, limit_of(word, candidate));
    const std::size_t distance = edit_distance(word, candidate, limit);
    if (distance < limit) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(const std::string& word, std::span<const std::string> candidates) {
  if (const std::string near = nearest(word, candidates); !near.empty()) {
    return fmt::format("did you mean '{}'?", near);
  }
  if (candidates.empty()) return "there are none";
  constexpr std::size_t kMost = 100;  // characters
  std::string shown;
  for (const std::string& candidate : candidates) {
    if (!shown.empty() && shown.size() + candidate.size() > kMost) return shown + ", …";
    shown += (shown.empty() ? "known are: " : ", ") + candidate;
  }
  return shown;
}

}  // namespace stride::core
