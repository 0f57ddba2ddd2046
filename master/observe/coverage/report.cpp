#include "master/observe/coverage/report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace stride::coverage {
namespace {

constexpr double kPercent = 100;

/// Words such as "nanometre" begin with none.
std::optional<double> leading_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

PointReport empty_point(const GroupDefinition& group, std::size_t place, std::uint64_t runs) {
  const PointDefinition& definition = group.points[place];
  PointReport point{.name = definition.name,
                    .definition = hash(group, definition),
                    .place = place,
                    .kind = definition.kind,
                    .signal = definition.signal,
                    .unit = definition.unit,
                    .at_least = definition.at_least,
                    .is_open = definition.is_open,
                    .declared = definition.bins.size(),
                    .runs = runs};
  for (const std::size_t part : definition.of) {
    point.of.push_back(group.points[part].name);
    point.of_definitions.push_back(hash(group, group.points[part]));
  }
  for (const DeclaredBin& bin : definition.bins) point.bins.push_back({bin.name, bin.is_ignored});
  return point;
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

Report empty_report(std::string scenario, std::span<const GroupDefinition> definitions,
                    std::uint64_t runs) {
  Report report{
      .scenario = std::move(scenario), .definition = hash(definitions), .cases = {}, .runs = runs};
  for (const GroupDefinition& definition : definitions) {
    GroupReport& group = report.groups.emplace_back();
    group.component = definition.name;
    group.goal = definition.goal;
    group.place = report.groups.size() - 1;
    for (std::size_t i = 0; i < definition.points.size(); ++i) {
      group.points.push_back(empty_point(definition, i, runs));
    }
  }
  return report;
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

}  // namespace stride::coverage
