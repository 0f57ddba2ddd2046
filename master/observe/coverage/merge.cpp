#include "master/observe/coverage/merge.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/saturated_sum.h"

namespace stride::coverage {
namespace {

constexpr std::uint64_t kNoCase = std::numeric_limits<std::uint64_t>::max();

std::optional<std::uint64_t> earlier_of(std::optional<std::uint64_t> a,
                                        std::optional<std::uint64_t> b) {
  return a && b ? std::min(a, b) : a ? a : b;
}

/// A case before what is of none.
void add(BinCount& bin, const BinCount& other) {
  const auto visit = [](const BinCount& of) {
    return std::tuple(of.in_case.value_or(kNoCase), of.first.value_or(0));
  };
  if (other.first && (!bin.first || visit(other) < visit(bin))) {
    bin.first = other.first;
    bin.in_case = other.in_case;
  }
  bin.count = core::saturated_sum(bin.count, other.count);
}

std::ptrdiff_t first_other(const PointReport& point) {
  return static_cast<std::ptrdiff_t>(point.declared);
}

/// Where a bin that was not declared is, or would be.
std::vector<BinCount>::iterator place_of(PointReport& point, const std::string& name) {
  return std::lower_bound(
      point.bins.begin() + first_other(point), point.bins.end(), name,
      [](const BinCount& a, const std::string& b) { return bin_order(a.name, b); });
}

void add_other(PointReport& point, const BinCount& bin) {
  auto place = place_of(point, bin.name);
  if (place == point.bins.end() || place->name != bin.name) {
    place = point.bins.insert(place, {bin.name, bin.is_ignored});
  }
  add(*place, bin);
}

/// What is kept depends on all bins that there are, not on which came first.
void fold_further(PointReport& point) {
  const auto is_further = [](const BinCount& bin) { return bin.name == kFurther; };
  const auto begin = point.bins.begin() + first_other(point);
  const auto further = std::find_if(begin, point.bins.end(), is_further);
  const auto most = static_cast<std::ptrdiff_t>(kMostOpenBins);
  auto end = point.bins.end() - begin > most ? begin + most : point.bins.end();
  if (end == point.bins.end()) return;
  if (further < end) ++end;
  BinCount rest{kFurther, true};
  for (auto bin = end; bin != point.bins.end(); ++bin) add(rest, *bin);
  point.bins.erase(end, point.bins.end());
  if (rest.count > 0) add_other(point, rest);
}

void require_same(const std::string& component, const PointReport& left, const PointReport& right) {
  bool are_same = left.kind == right.kind && left.declared == right.declared;
  for (std::size_t i = 0; are_same && i < left.declared; ++i) {
    are_same = left.bins[i].name == right.bins[i].name;
  }
  if (are_same) return;
  throw std::invalid_argument(
      fmt::format("'{}', point '{}': both have the definition {}, and not the same bins", component,
                  left.name, left.definition));
}

void merge(PointReport& point, const PointReport& other) {
  for (std::size_t i = 0; i < point.declared; ++i) add(point.bins[i], other.bins[i]);
  for (std::size_t i = other.declared; i < other.bins.size(); ++i) add_other(point, other.bins[i]);
  fold_further(point);
  point.place = std::min(point.place, other.place);
  point.runs = core::saturated_sum(point.runs, other.runs);
  point.first_case = earlier_of(point.first_case, other.first_case);
}

/// All of one name beside each other; of those the one that was there first.
void sort_points(std::vector<PointReport>& points) {
  std::map<std::string, std::size_t> places;
  for (const PointReport& point : points) {
    std::size_t& place = places.try_emplace(point.name, point.place).first->second;
    place = std::min(place, point.place);
  }
  std::ranges::sort(points, {}, [&](const PointReport& point) {
    return std::tuple(places.at(point.name), std::string_view(point.name),
                      point.first_case.value_or(kNoCase), std::string_view(point.definition));
  });
}

void merge(GroupReport& group, const GroupReport& other) {
  for (const PointReport& point : other.points) {
    const auto same = std::ranges::find_if(group.points, [&](const PointReport& own) {
      return own.definition == point.definition && own.name == point.name;
    });
    if (same == group.points.end()) {
      group.points.push_back(point);
    } else {
      require_same(group.component, *same, point);
      merge(*same, point);
    }
  }
  sort_points(group.points);
  group.goal = std::max(group.goal, other.goal);
  group.place = std::min(group.place, other.place);
}

void merge_groups(std::vector<GroupReport>& groups, const std::vector<GroupReport>& others) {
  for (const GroupReport& other : others) {
    const auto same = std::ranges::find(groups, other.component, &GroupReport::component);
    if (same == groups.end()) {
      groups.push_back(other);
    } else {
      merge(*same, other);
    }
  }
  std::ranges::sort(groups, {}, [](const GroupReport& group) {
    return std::tuple(group.place, std::string_view(group.component));
  });
}

/// Of two lists with commas, each once and in order.
std::string merged_names(std::string_view names, std::string_view further) {
  constexpr std::string_view kComma = ", ";
  std::set<std::string_view> all;
  for (std::string_view rest : {names, further}) {
    while (true) {
      const std::size_t end = std::min(rest.find(kComma), rest.size());
      if (end > 0) all.insert(rest.substr(0, end));
      if (end == rest.size()) break;
      rest.remove_prefix(end + kComma.size());
    }
  }
  return fmt::format("{}", fmt::join(all, kComma));
}

std::string definition_of(const std::vector<GroupReport>& groups) {
  std::vector<GroupDigest> digests;
  for (const GroupReport& group : groups) {
    GroupDigest& digest = digests.emplace_back(GroupDigest{group.component, group.goal});
    for (const PointReport& point : group.points) digest.points.push_back(point.definition);
  }
  return hash(digests);
}

template <class Named>
auto* find(std::vector<Named>& all, const std::string& name, std::string Named::*member) {
  const auto found = std::ranges::find(all, name, member);
  return found == all.end() ? nullptr : &*found;
}

/// The bins of a case stand in the order of those of the point.
void add_case(PointReport& point, const PointDefinition& definition, const CoveredPoint& covered,
              std::uint64_t index) {
  std::size_t next = 0;
  for (const CoveredBin& bin : covered.bins) {
    const BinCount visits{bin.name, definition.ignores(bin.name), bin.count, bin.first, index};
    std::size_t tried = 0;
    while (tried < point.declared && point.bins[next].name != bin.name) {
      next = (next + 1) % point.declared;
      ++tried;
    }
    if (tried < point.declared) {
      add(point.bins[next], visits);
    } else {
      add_other(point, visits);
    }
  }
  fold_further(point);
}

}  // namespace

void merge(Report& report, const Report& other) {
  merge_groups(report.groups, other.groups);
  report.scenario = merged_names(report.scenario, other.scenario);
  report.definition = definition_of(report.groups);
  report.runs = core::saturated_sum(report.runs, other.runs);
  if (report.cases || other.cases) {
    report.cases = core::saturated_sum(report.cases.value_or(0), other.cases.value_or(0));
  }
}

void add_case(Report& report, std::span<const GroupDefinition> definitions,
              const CoveredBins& covered, std::uint64_t index) {
  for (GroupReport& group : report.groups) {
    for (PointReport& point : group.points) {
      ++point.runs;
      point.first_case = earlier_of(point.first_case, index);
    }
  }
  ++report.runs;
  report.cases = report.cases.value_or(0) + 1;
  for (const CoveredGroup& of_group : covered) {
    GroupReport* const group = find(report.groups, of_group.component, &GroupReport::component);
    if (group == nullptr) continue;
    const GroupDefinition& definition =
        definitions[static_cast<std::size_t>(group - report.groups.data())];
    for (const CoveredPoint& of_point : of_group.points) {
      PointReport* const point = find(group->points, of_point.name, &PointReport::name);
      if (point == nullptr) continue;
      add_case(*point, definition.points[static_cast<std::size_t>(point - group->points.data())],
               of_point, index);
    }
  }
}

std::vector<std::optional<double>> percentages(std::span<const GroupDefinition> definitions,
                                               const CoveredBins& covered) {
  Report report = empty_report("", definitions, 0);
  add_case(report, definitions, covered, 0);
  std::vector<std::optional<double>> all;
  for (const GroupReport& group : report.groups) all.push_back(group.percentage());
  return all;
}

}  // namespace stride::coverage
