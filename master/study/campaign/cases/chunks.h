// How the cases of a campaign that are missing are divided among the jobs of a cluster.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CHUNKS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CHUNKS_H

#include <cstdint>
#include <optional>
#include <vector>

#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_range.h"

namespace stride::campaign {

/// Which cases have a record.
struct CaseSurvey {
  std::vector<bool> is_missing;
  std::uint64_t missing = 0;
  std::optional<double> wall_time{};  ///< of a case that is done, on average [s]
};
CaseSurvey survey(const CaseFolder& cases, std::uint64_t count);

inline constexpr double kJobTime = 300;  // [s]
inline constexpr std::uint64_t kJobsOfUnknownTime = 100;

/// With cases of known time a job takes `job_time`, and no longer than half of its limit; otherwise
/// there are a hundred jobs. In both, no more than `most_chunks`.
struct ChunkNeeds {
  std::optional<double> wall_time{};   ///< of a case [s]; nothing: not known
  std::optional<double> time_limit{};  ///< of a job [s]
  double job_time = kJobTime;          ///< [s]; 0: no longer than it has to
  std::uint64_t side_by_side = 1;      ///< cases that run at the same time in a job
  std::uint64_t most_chunks = 1;
};

/// How many of the missing cases, of which there is one at least, a job runs: all jobs nearly as
/// many.
std::uint64_t chunk_length(std::uint64_t missing, const ChunkNeeds& needs);

/// Ranges that follow each other. Each holds so many missing cases, but for the last one, begins
/// and ends with one, and may have others between them.
std::vector<CaseRange> chunks(const std::vector<bool>& is_missing, std::uint64_t length);

/// How many jobs that makes.
std::uint64_t chunk_count(std::uint64_t missing, std::uint64_t length);

}  // namespace stride::campaign

#endif
