#include "master/study/search/search_space.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "master/base/error.h"

namespace stride::search {
namespace {

using namespace campaign;

std::size_t count_dimensions(const Campaign& campaign) {
  if (const auto* const drawn = std::get_if<Stochastic>(&campaign.variation)) {
    return drawn->parameters.size();
  }
  return std::get<Deterministic>(campaign.variation).factors.size();
}

/// Quantiles are those of numbers above 0 and below 1.
double inside(double u) {
  constexpr double kEdge = 0x1p-20;
  return std::clamp(u, kEdge, 1 - kEdge);
}

void set_values(const Factor& factor, double u, std::vector<Text>& values) {
  const std::uint64_t size = size_of(factor);
  const auto place = std::min(static_cast<std::uint64_t>(u * static_cast<double>(size)), size - 1);
  if (const auto* const range = std::get_if<ValueRange>(&factor)) {
    values[range->parameter] = step_text(range->first, range->step, place);
    return;
  }
  const ValueTable& table = std::get<ValueTable>(factor);
  for (std::size_t i = 0; i < table.parameters.size(); ++i) {
    values[table.parameters[i]] = table.rows[place].values[i];
  }
}

}  // namespace

SearchSpace::SearchSpace(const Campaign& campaign, const std::vector<ValueKind>& kinds)
    : campaign_(campaign), kinds_(kinds), dimensions_(count_dimensions(campaign)) {
  if (dimensions_ > 0) return;
  core::fail_input({.where = {campaign.file.string(), 0}},
                   "nothing varies in this campaign, so there is nothing to search");
}

std::vector<Text> SearchSpace::values(const Point& point) const {
  std::vector<Text> values(campaign_.parameters.size());
  if (const auto* const drawn = std::get_if<Stochastic>(&campaign_.variation)) {
    for (std::size_t i = 0; i < dimensions_; ++i) {
      const auto& [parameter, distribution, where] = drawn->parameters[i];
      values[parameter] = drawn_text(kinds_[parameter], distribution, inside(point[i]));
    }
    return values;
  }
  const auto& factors = std::get<Deterministic>(campaign_.variation).factors;
  for (std::size_t i = 0; i < dimensions_; ++i) set_values(factors[i], point[i], values);
  return values;
}

std::vector<Text> SearchSpace::nominal() const {
  return std::vector<Text>(campaign_.parameters.size());
}

}  // namespace stride::search
