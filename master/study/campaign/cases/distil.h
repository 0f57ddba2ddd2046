// The fewest cases that are as good as all of them.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_DISTIL_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_DISTIL_H

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/observe/coverage/definition.h"
#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_record.h"

namespace stride::campaign {

/// A case, and all that it is good for: what it covers and how often, and how it has ended, which
/// is once.
struct DistilCandidate {
  std::uint64_t index = 0;
  std::map<std::string, std::uint64_t> items{};  ///< each once at least
};

/// How often an item is wanted; once where it is not here.
using Wanted = std::map<std::string, std::uint64_t>;

struct DistilledCase {
  std::uint64_t index = 0;
  std::set<std::string> alone{};  ///< the items of which the other chosen ones have too few
};

/// Cases that together have all items of all candidates, each as often as it is wanted, or once if
/// all candidates together have it less often, and of which none can be left out; ascending. By
/// greedy cover, which takes the case that adds the most of what is still missing (of several the
/// first), and then removal of those that have become redundant, the last case first. Where each of
/// m items is wanted once that is at most 1 + 1/2 + … + 1/m times as many as the fewest that would
/// do (V. Chvátal, "A greedy heuristic for the set-covering problem", Mathematics of Operations
/// Research 4, 1979); otherwise m is the sum of how often items are wanted (L. A. Wolsey, "An
/// analysis of the greedy algorithm for the submodular set covering problem", Combinatorica 2,
/// 1982). No two candidates have one index.
std::vector<DistilledCase> distil(std::span<const DistilCandidate> candidates,
                                  const Wanted& wanted = {});

/// How a case has ended: "passed", "failed by 'a', 'b'", "crashed". Of cases with the same outcome
/// and the same failed checks and verdicts it is the same.
std::string ending_of(const CaseResult& result);

/// The bins of a component that cases have hit, and that count: "POINT: BIN". Of a point that means
/// something else in a case than in the scenario it is "POINT@DEFINITION: BIN".
class CountedBins {
 public:
  /// The definitions must outlive this object.
  CountedBins(std::string component, CaseDefinitions& definitions)
      : component_(std::move(component)), definitions_(definitions) {}

  /// With the number of visits. Empty where the record has no coverage of it, or nothing says any
  /// more which bins it had.
  std::map<std::string, std::uint64_t> of(const CaseResult& result, std::uint64_t index);
  /// The visits after which the bins are covered, of all that of() has returned, where these are
  /// more than one.
  const Wanted& wanted() const { return wanted_; }

 private:
  const coverage::GroupDefinition* group_in(const CaseDefinitions::Definitions& all) const;
  std::string title(const coverage::GroupDefinition& group,
                    const coverage::PointDefinition& point) const;

  std::string component_;
  CaseDefinitions& definitions_;
  Wanted wanted_;
};

}  // namespace stride::campaign

#endif
