#include "master/observe/coverage/demand.h"

#include <cmath>

#include <fmt/format.h>

#include "master/base/text/counted.h"

namespace stride::coverage {
namespace {

constexpr std::size_t kMostNames = 3;

std::string bins_text(const PointReport& point) {
  const std::string missing = missing_text(point, kMostNames);
  return fmt::format("{} of {}{}", point.covered(), core::counted(point.countable(), "bin"),
                     missing.empty() ? "" : "; not " + missing);
}

std::string points_text(const GroupReport& group) {
  std::size_t all = 0;
  std::vector<std::string> missing;
  for (const PointReport& point : group.points) {
    if (!point.percentage()) continue;
    ++all;
    if (point.covered() < point.countable()) missing.push_back(point.name);
  }
  const std::size_t whole = all - missing.size();
  return fmt::format("{} of {} as a whole{}", whole, core::counted(all, "point"),
                     missing.empty() ? "" : "; not " + core::abridged(missing, kMostNames));
}

core::Verdict verdict(const Demand& demand, const GroupReport& group, Time reached,
                      bool is_complete) {
  const PointReport* const point = demand.point ? &group.points[*demand.point] : nullptr;
  const std::optional<double> percentage =
      point != nullptr ? point->percentage() : group.percentage();
  const bool is_met = percentage >= demand.min;
  core::Verdict verdict;
  verdict.name = demand.name;
  verdict.kind = "covered";
  verdict.where = demand.where;
  if (!percentage) {
    verdict.text = "there is no bin that counts";
    return verdict;
  }
  verdict.text = fmt::format("{}: {}", percentage_text(percentage),
                             point != nullptr ? bins_text(*point) : points_text(group));
  if (!is_met && !is_complete) {
    verdict.text += ", where the run ended before its end";
    return verdict;
  }
  verdict.passed = is_met;
  if (!is_met) {
    verdict.text += fmt::format("; expected {} % at least", demand.min);
    verdict.time = reached;
  }
  verdict.margin = core::Margin{*percentage - demand.min, "percentage points", reached};
  return verdict;
}

}  // namespace

std::vector<core::Verdict> verdicts(std::span<const Demand> demands, const Report& report,
                                    Time reached, bool is_complete) {
  std::vector<core::Verdict> all;
  for (const Demand& demand : demands) {
    all.push_back(verdict(demand, report.groups[demand.group], reached, is_complete));
  }
  return all;
}

std::string missing_text(const PointReport& point, std::size_t most) {
  std::vector<std::string> names;
  for (const BinCount& bin : point.bins) {
    if (!bin.is_ignored && bin.count < point.at_least) names.push_back(bin.name);
  }
  return names.empty() ? "" : core::abridged(names, most);
}

std::string percentage_text(std::optional<double> percentage) {
  if (!percentage) return "-";
  constexpr double kHundredths = 100;
  return fmt::format("{} %", std::floor(*percentage * kHundredths) / kHundredths);
}

}  // namespace stride::coverage
