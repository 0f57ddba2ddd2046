#include "master/study/campaign/evaluation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stride::campaign {
namespace {

/// Of the standard normal distribution, at 97.5 %.
constexpr double kQuantile = 1.959963984540054;

/// Both vary, or there is none.
std::optional<double> pearson(std::span<const double> x, std::span<const double> y) {
  const auto count = static_cast<double>(x.size());
  const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / count;
  const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / count;
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0) || !(yy > 0)) return std::nullopt;
  return std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
}

std::optional<Confidence> confidence_of(double r, std::size_t count) {
  if (count < 4 || std::abs(r) == 1) return std::nullopt;
  const double spread = kQuantile * std::sqrt((1 + r * r / 2) / (static_cast<double>(count) - 3));
  return Confidence{std::tanh(std::atanh(r) - spread), std::tanh(std::atanh(r) + spread)};
}

}  // namespace

std::vector<double> mid_ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t place) { return values[place]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    const double rank = static_cast<double>(first + last) / 2 + 1;
    for (; first <= last; ++first) ranks[order[first]] = rank;
  }
  return ranks;
}

RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y) {
  std::vector<double> known_x, known_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i]) || std::isnan(y[i])) continue;
    known_x.push_back(x[i]);
    known_y.push_back(y[i]);
  }
  RankCorrelation found{.count = known_x.size(), .value = {}, .confidence = {}};
  if (known_x.empty()) return found;
  found.value = pearson(mid_ranks(known_x), mid_ranks(known_y));
  if (found.value) found.confidence = confidence_of(*found.value, found.count);
  return found;
}

Confidence share_confidence(std::uint64_t hits, std::uint64_t count) {
  const auto n = static_cast<double>(count);
  const double share = static_cast<double>(hits) / n;
  const double z2 = kQuantile * kQuantile;
  const double middle = share + z2 / (2 * n);
  const double spread = kQuantile * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n));
  const double scale = 1 + z2 / n;
  return {hits == 0 ? 0 : (middle - spread) / scale, hits == count ? 1 : (middle + spread) / scale};
}

}  // namespace stride::campaign
