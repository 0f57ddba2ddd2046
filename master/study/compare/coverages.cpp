#include "master/study/compare/coverages.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/counted.h"

namespace stride::compare {
namespace {

/// Of each bin of a point how often it was hit.
using Hits = std::map<std::string, std::uint64_t>;
using Points = std::map<std::string, Hits>;

Points points_of(const coverage::Report& report) {
  Points points;
  for (const coverage::GroupReport& group : report.groups) {
    for (const coverage::PointReport& point : group.points) {
      Hits& hits = points[group.component + "." + point.name];
      for (const coverage::BinCount& bin : point.bins) hits[bin.name] += bin.count;
    }
  }
  return points;
}

std::uint64_t count_in(const Hits& hits, const std::string& bin) {
  const auto found = hits.find(bin);
  return found == hits.end() ? 0 : found->second;
}

void compare_hits(const std::string& name, const Hits& a, const Hits& b, Differences& differences) {
  Hits bins = a;
  bins.insert(b.begin(), b.end());
  Difference difference{Kind::Coverage, name, {}, {}, {}, 0};
  for (const auto& [bin, hits] : bins) {
    const std::uint64_t mine = count_in(a, bin);
    const std::uint64_t other = count_in(b, bin);
    if (mine == other || ++difference.count > 1) continue;
    difference.a = bin + ": " + core::counted(mine, "hit");
    difference.b = bin + ": " + core::counted(other, "hit");
  }
  if (difference.count > 0) differences.push_back(std::move(difference));
}

}  // namespace

Differences compare_coverages(const coverage::Report& a, const coverage::Report& b) {
  const Points points_a = points_of(a);
  const Points points_b = points_of(b);
  Points all = points_a;
  all.insert(points_b.begin(), points_b.end());
  Differences differences;
  for (const auto& [name, hits] : all) {
    const auto mine = points_a.find(name);
    const auto other = points_b.find(name);
    if (mine == points_a.end() || other == points_b.end()) {
      const bool is_in_a = mine != points_a.end();
      differences.push_back(
          {Kind::Coverage, name, {}, is_in_a ? "counted" : "none", is_in_a ? "none" : "counted"});
    } else {
      compare_hits(name, mine->second, other->second, differences);
    }
  }
  return differences;
}

}  // namespace stride::compare
