// How near a case is to a failure, as one number.
#ifndef STRIDE_MASTER_STUDY_SEARCH_OBJECTIVE_H
#define STRIDE_MASTER_STUDY_SEARCH_OBJECTIVE_H

#include <map>
#include <optional>
#include <set>
#include <string>

#include "master/study/campaign/cases/case_record.h"

namespace stride::search {

/// What a case has failed by; empty if it has passed. Checks and verdicts of units by their names;
/// of a case that did not come to its end, its outcome.
std::set<std::string> failures_of(const campaign::CaseResult& result);

/// Whether there are verdicts: of another case nothing is known but that it has failed.
bool came_to_its_end(const campaign::CaseResult& result);

/// The least of the margins, each divided by that of the nominal case: they have different units of
/// measure, and in the nominal case each is 1. Margins that are infinite or unknown there are not
/// divided. A check whose margin is 0 there is at its limit without being near a failure (a number
/// of messages that is exact, a value that begins at its bound): it counts only where it has
/// failed, unless no check with another margin is left; then it is not divided.
class Objective {
 public:
  /// `check`: its margin alone; empty: those of all checks.
  Objective(std::string check, const campaign::CaseResult& nominal);

  /// Below 0 if it has failed, above 0 if it has passed; -infinity for a case that did not come to
  /// its end, infinity where no margin is known.
  double value(const campaign::CaseResult& result) const;
  /// From here on this failure is none, so that others are found.
  void disregard(const std::string& failure) { disregarded_.insert(failure); }
  /// Those that are not disregarded, and that the check, if there is one, is about.
  std::set<std::string> failures_in(const campaign::CaseResult& result) const;
  /// Whether there is a margin left to minimise.
  bool is_exhausted(const campaign::CaseResult& nominal) const;

 private:
  bool counts(const std::string& name) const {
    return (check_.empty() || name == check_) && !disregarded_.contains(name);
  }

  bool has_scale() const;
  double distance(const campaign::CaseVerdict& verdict, bool counts_at_limit) const;

  std::string check_;
  std::map<std::string, double> scales_;  ///< by names of checks
  std::set<std::string> at_limit_;        ///< in the nominal case
  std::set<std::string> disregarded_;
};

}  // namespace stride::search

#endif
