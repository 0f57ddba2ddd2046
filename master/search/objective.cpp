#include "master/search/objective.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stride::search {
namespace {

using campaign::CaseResult;
using campaign::CaseVerdict;
using campaign::Outcome;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool came_to_its_end(const CaseResult& result) {
  return result.outcome == Outcome::Passed || result.outcome == Outcome::Failed;
}

/// A failure that its margin does not tell, such as a unit's, is as near as can be.
double distance(const CaseVerdict& verdict, double scale) {
  constexpr double kJustFailed = -std::numeric_limits<double>::min();
  if (verdict.margin) {
    const double scaled = verdict.margin->value / scale;
    return verdict.passed == false ? std::min(scaled, kJustFailed) : scaled;
  }
  return verdict.passed == false ? kJustFailed : kInfinity;
}

}  // namespace

std::set<std::string> failures_of(const CaseResult& result) {
  if (!came_to_its_end(result)) return {name(result.outcome)};
  std::set<std::string> failures;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (verdict.passed == false) failures.insert(verdict.name);
  }
  return failures;
}

Objective::Objective(std::string check, const CaseResult& nominal) : check_(std::move(check)) {
  for (const CaseVerdict& verdict : nominal.verdicts) {
    if (!verdict.margin) continue;
    const double size = std::abs(verdict.margin->value);
    if (size > 0 && std::isfinite(size)) scales_[verdict.name] = size;
  }
}

double Objective::value(const CaseResult& result) const {
  if (!came_to_its_end(result)) return counts(name(result.outcome)) ? -kInfinity : kInfinity;
  double least = kInfinity;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (!counts(verdict.name)) continue;
    const auto scale = scales_.find(verdict.name);
    least = std::min(least, distance(verdict, scale == scales_.end() ? 1 : scale->second));
  }
  return least;
}

std::set<std::string> Objective::failures_in(const CaseResult& result) const {
  std::set<std::string> failures = failures_of(result);
  std::erase_if(failures, [&](const std::string& failure) { return !counts(failure); });
  return failures;
}

bool Objective::is_exhausted(const CaseResult& nominal) const {
  return std::ranges::none_of(nominal.verdicts,
                              [&](const CaseVerdict& verdict) { return counts(verdict.name); });
}

}  // namespace stride::search
