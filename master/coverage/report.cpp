#include "master/coverage/report.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace stride::coverage {
namespace {

constexpr double kPercent = 100;

std::optional<double> leading_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} ? std::optional(number) : std::nullopt;
}

/// The bin of this name; where it is new, in its place among those from `first_other` on.
BinCount& find_or_add(PointReport& point, std::size_t first_other, const std::string& name,
                      bool is_ignored) {
  const auto found = std::ranges::find(point.bins, name, &BinCount::name);
  if (found != point.bins.end()) return *found;
  if (point.bins.size() - first_other >= kMostOpenBins && name != kFurther) {
    return find_or_add(point, first_other, kFurther, true);
  }
  const auto place = std::upper_bound(
      point.bins.begin() + static_cast<std::ptrdiff_t>(first_other), point.bins.end(), name,
      [](const std::string& a, const BinCount& b) { return bin_order(a, b.name); });
  return *point.bins.insert(place, {name, is_ignored});
}

void check_same(const std::string& what, const std::string& left, const std::string& right) {
  if (left == right) return;
  throw std::invalid_argument(
      fmt::format("{} is '{}' in one and '{}' in the other", what, left, right));
}

void check_same(const std::string& what, std::size_t left, std::size_t right) {
  if (left == right) return;
  throw std::invalid_argument(
      fmt::format("there are {} {} in one and {} in the other", left, what, right));
}

void check_same(const std::string& component, const PointReport& left, const PointReport& right) {
  const std::string point = fmt::format("'{}', point '{}': ", component, left.name);
  check_same(fmt::format("'{}': the name of a point", component), left.name, right.name);
  check_same(point + "the kind", name(left.kind), name(right.kind));
  check_same(point + "the signal", left.signal, right.signal);
  check_same(point + "at_least", std::to_string(left.at_least), std::to_string(right.at_least));
  check_same(point + "open", left.is_open ? "true" : "false", right.is_open ? "true" : "false");
  if (left.is_open) return;
  const auto countable = [](const PointReport& all) {
    std::vector<std::string> names;
    for (const BinCount& bin : all.bins) {
      if (!bin.is_ignored) names.push_back(bin.name);
    }
    return names;
  };
  const std::vector<std::string> bins = countable(left);
  const std::vector<std::string> others = countable(right);
  for (std::size_t i = 0; i < std::min(bins.size(), others.size()); ++i) {
    check_same(point + fmt::format("bin {}", i + 1), bins[i], others[i]);
  }
  check_same(point + "bins that count", bins.size(), others.size());
}

/// Where the definitions differ in what can be seen of them.
void check_same_definition(const Report& report, const Report& other) {
  check_same("groups", report.groups.size(), other.groups.size());
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    const GroupReport& left = report.groups[i];
    const GroupReport& right = other.groups[i];
    check_same("the component of a group", left.component, right.component);
    check_same(fmt::format("'{}': points", left.component), left.points.size(),
               right.points.size());
    for (std::size_t k = 0; k < left.points.size(); ++k) {
      check_same(left.component, left.points[k], right.points[k]);
    }
    const auto goal = [](const GroupReport& group) {
      return group.goal ? fmt::format("{}", *group.goal) : "none";
    };
    check_same(fmt::format("'{}': the goal", left.component), goal(left), goal(right));
  }
  if (report.definition == other.definition) return;
  throw std::invalid_argument("their definitions ignore different bins");
}

void add(BinCount& bin, const BinCount& other) {
  const auto is_earlier = [&] {
    if (bin.in_case && other.in_case) {
      return std::tie(*other.in_case, *other.first) < std::tie(*bin.in_case, *bin.first);
    }
    return *other.first < *bin.first;
  };
  if (other.first && (!bin.first || is_earlier())) {
    bin.first = other.first;
    bin.in_case = other.in_case;
  }
  const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - bin.count;
  bin.count += std::min(other.count, room);
}

/// The declared bins are the same, and stand first.
void merge(PointReport& point, const PointReport& other) {
  std::size_t same = 0;
  while (same < std::min(point.bins.size(), other.bins.size()) &&
         point.bins[same].name == other.bins[same].name) {
    ++same;
  }
  for (const BinCount& bin : other.bins) {
    add(find_or_add(point, same, bin.name, bin.is_ignored), bin);
  }
}

void merge_names(std::string& names, const std::string& further) {
  const std::string all = fmt::format(", {}, ", names);
  if (all.find(fmt::format(", {}, ", further)) == all.npos) names += ", " + further;
}

template <class Named>
auto* find(std::vector<Named>& all, const std::string& name, std::string Named::*member) {
  const auto found = std::ranges::find(all, name, member);
  return found == all.end() ? nullptr : &*found;
}

std::vector<GroupReport> empty_groups(std::span<const GroupDefinition> definitions) {
  std::vector<GroupReport> groups;
  for (const GroupDefinition& definition : definitions) {
    GroupReport& group = groups.emplace_back();
    group.component = definition.name;
    group.goal = definition.goal;
    for (const PointDefinition& point : definition.points) {
      PointReport& added = group.points.emplace_back();
      added.name = point.name;
      added.kind = point.kind;
      added.signal = point.signal;
      added.unit = point.unit;
      added.at_least = point.at_least;
      added.is_open = point.is_open;
      for (const std::size_t part : point.of) added.of.push_back(definition.points[part].name);
      for (const DeclaredBin& bin : point.bins) added.bins.push_back({bin.name, bin.is_ignored});
    }
  }
  return groups;
}

}  // namespace

bool bin_order(const std::string& a, const std::string& b) {
  const auto left = leading_number(a);
  const auto right = leading_number(b);
  if (left && right && *left != *right) return *left < *right;
  if (left.has_value() != right.has_value()) return left.has_value();
  return a < b;
}

std::size_t PointReport::countable() const {
  return static_cast<std::size_t>(std::ranges::count(bins, false, &BinCount::is_ignored));
}

std::size_t PointReport::covered() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      bins, [&](const BinCount& bin) { return !bin.is_ignored && bin.count >= at_least; }));
}

std::optional<double> PointReport::percentage() const {
  const std::size_t all = countable();
  if (is_open || all == 0) return std::nullopt;
  return kPercent * static_cast<double>(covered()) / static_cast<double>(all);
}

std::optional<double> GroupReport::percentage() const {
  double sum = 0;
  std::size_t count = 0;
  for (const PointReport& point : points) {
    const auto percentage = point.percentage();
    if (!percentage) continue;
    sum += *percentage;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

bool GroupReport::misses_goal() const { return goal && percentage().value_or(0) < *goal; }

Report empty_report(std::string scenario, std::span<const GroupDefinition> definitions) {
  return {.scenario = std::move(scenario),
          .definition = hash(definitions),
          .groups = empty_groups(definitions)};
}

CoveredBins covered_bins(const Report& report) {
  CoveredBins covered;
  for (const GroupReport& group : report.groups) {
    CoveredGroup& of_group = covered.emplace_back(CoveredGroup{group.component});
    for (const PointReport& point : group.points) {
      CoveredPoint of_point{point.name};
      for (const BinCount& bin : point.bins) {
        if (bin.count > 0) of_point.bins.push_back({bin.name, bin.count, bin.first.value_or(0)});
      }
      if (!of_point.bins.empty()) of_group.points.push_back(std::move(of_point));
    }
  }
  return covered;
}

void add_case(Report& report, std::span<const GroupDefinition> definitions,
              const CoveredBins& covered, std::uint64_t index) {
  for (const CoveredGroup& of_group : covered) {
    GroupReport* const group = find(report.groups, of_group.component, &GroupReport::component);
    if (group == nullptr) continue;
    const GroupDefinition& definition =
        definitions[static_cast<std::size_t>(group - report.groups.data())];
    for (const CoveredPoint& of_point : of_group.points) {
      PointReport* const point = find(group->points, of_point.name, &PointReport::name);
      if (point == nullptr) continue;
      const PointDefinition& defined =
          definition.points[static_cast<std::size_t>(point - group->points.data())];
      for (const CoveredBin& bin : of_point.bins) {
        add(find_or_add(*point, defined.bins.size(), bin.name, defined.ignores(bin.name)),
            {bin.name, false, bin.count, bin.first, index});
      }
    }
  }
}

std::vector<std::optional<double>> percentages(std::span<const GroupDefinition> definitions,
                                               const CoveredBins& covered) {
  Report report{.groups = empty_groups(definitions)};
  add_case(report, definitions, covered, 0);
  std::vector<std::optional<double>> all;
  for (const GroupReport& group : report.groups) all.push_back(group.percentage());
  return all;
}

void merge(Report& report, const Report& other) {
  check_same_definition(report, other);
  merge_names(report.scenario, other.scenario);
  if (report.cases && other.cases) {
    *report.cases += *other.cases;
  } else if (other.cases) {
    report.cases = other.cases;
  }
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    for (std::size_t k = 0; k < report.groups[i].points.size(); ++k) {
      merge(report.groups[i].points[k], other.groups[i].points[k]);
    }
  }
}

}  // namespace stride::coverage
