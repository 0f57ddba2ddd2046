// The fewest cases that are as good as all of them.
#ifndef STRIDE_MASTER_CAMPAIGN_DISTIL_H
#define STRIDE_MASTER_CAMPAIGN_DISTIL_H

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "master/campaign/case_record.h"
#include "master/coverage/definition.h"

namespace stride::campaign {

/// A case, and all that it is good for: what it covers, and how it has ended.
struct DistilCandidate {
  std::uint64_t index = 0;
  std::set<std::string> items{};
};

struct DistilledCase {
  std::uint64_t index = 0;
  std::set<std::string> alone{};  ///< the items that no other chosen one has
};

/// Cases that together have all items of all candidates, and of which none can be left out;
/// ascending. By greedy set cover, which takes the case with the most items that are still missing
/// (of several the first), and then removal of those that have become redundant, the last case
/// first. For m items that is at most 1 + 1/2 + … + 1/m times as many as the fewest that would do
/// (V. Chvátal, "A greedy heuristic for the set-covering problem", Mathematics of Operations
/// Research 4, 1979). No two candidates have one index.
std::vector<DistilledCase> distil(std::span<const DistilCandidate> candidates);

/// How a case has ended: "passed", "failed by 'a', 'b'", "crashed". Of cases with the same outcome
/// and the same failed checks and verdicts it is the same.
std::string ending_of(const CaseResult& result);

/// The bins of a component that cases have hit, and that count: "POINT: BIN".
class CountedBins {
 public:
  /// `coverage` is that of the scenario, and must outlive this object.
  CountedBins(std::string component, std::span<const coverage::GroupDefinition> coverage);

  /// Empty where the record has no coverage of it. Of a case whose units give another definition
  /// all bins count.
  std::set<std::string> of(const CaseResult& result) const;

 private:
  bool counts(const std::string& point, const std::string& bin) const;

  std::string component_;
  std::span<const coverage::GroupDefinition> coverage_;
  std::string definition_;
};

}  // namespace stride::campaign

#endif
