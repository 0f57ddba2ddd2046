#include "master/study/search/objective.h"

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

/// Of a failure that its margin does not tell, such as a unit's.
constexpr double kJustFailed = -std::numeric_limits<double>::min();

}  // namespace

bool came_to_its_end(const CaseResult& result) {
  return result.outcome == Outcome::Passed || result.outcome == Outcome::Failed;
}

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
    if (size == 0) {
      at_limit_.insert(verdict.name);
    } else if (std::isfinite(size)) {
      scales_[verdict.name] = size;
    }
  }
}

bool Objective::has_scale() const {
  return std::ranges::any_of(scales_, [&](const auto& scale) { return counts(scale.first); });
}

double Objective::distance(const CaseVerdict& verdict, bool counts_at_limit) const {
  const bool has_failed = verdict.passed == false;
  if (!verdict.margin) return has_failed ? kJustFailed : kInfinity;
  if (!has_failed && !counts_at_limit && at_limit_.contains(verdict.name)) return kInfinity;
  const auto scale = scales_.find(verdict.name);
  const double scaled = verdict.margin->value / (scale == scales_.end() ? 1 : scale->second);
  return has_failed ? std::min(scaled, kJustFailed) : scaled;
}

double Objective::value(const CaseResult& result) const {
  if (!came_to_its_end(result)) return counts(name(result.outcome)) ? -kInfinity : kInfinity;
  const bool counts_at_limit = !has_scale();
  double least = kInfinity;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (counts(verdict.name)) least = std::min(least, distance(verdict, counts_at_limit));
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
