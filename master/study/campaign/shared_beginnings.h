// Cases whose runs are the same up to an instant.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_SHARED_BEGINNINGS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_SHARED_BEGINNINGS_H

#include <cstdint>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/study/campaign/plan.h"
#include "master/system/declaration/interventions.h"

namespace stride::campaign {

struct SharedBeginning {
  Time until{};  ///< where the earliest intervention of one of them begins
  std::vector<std::uint64_t> cases;
};

/// Puts those cases together that differ by their interventions alone, by whose beginning within
/// the run they are the same, and of which as much may be kept. A case that is like no other is
/// alone, with any instant. In the order of their first cases.
std::vector<SharedBeginning> shared_beginnings(const Plan& plan,
                                               std::span<const std::uint64_t> cases,
                                               const scenario::RunTimes& times);

}  // namespace stride::campaign

#endif
