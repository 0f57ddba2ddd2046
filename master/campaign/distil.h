// The fewest cases that are as good as all of them.
#ifndef STRIDE_MASTER_CAMPAIGN_DISTIL_H
#define STRIDE_MASTER_CAMPAIGN_DISTIL_H

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/campaign/case_record.h"

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

/// The bins of this component's coverage that the record of a case lists: "POINT: BIN". Empty where
/// it lists none.
std::set<std::string> covered_bins(std::string_view record, const std::string& component);

}  // namespace stride::campaign

#endif
