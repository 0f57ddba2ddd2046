#include "master/study/campaign/cases/chunks.h"

#include <algorithm>

namespace stride::campaign {
namespace {

/// Before jobs are made longer because there may not be so many.
std::uint64_t wanted_length(std::uint64_t missing, const ChunkNeeds& needs) {
  if (!needs.wall_time) return chunk_count(missing, kJobsOfUnknownTime);
  const double time = std::min(needs.job_time, needs.time_limit.value_or(2 * kJobTime) / 2);
  const double one_by_one = time / std::max(*needs.wall_time, 1e-6);
  return static_cast<std::uint64_t>(one_by_one * static_cast<double>(needs.side_by_side));
}

}  // namespace

CaseSurvey survey(const CaseFolder& cases, std::uint64_t count) {
  CaseSurvey survey{.is_missing = std::vector<bool>(count)};
  double wall_time = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto record = cases.read(i);
    survey.is_missing[i] = !record.has_value();
    survey.missing += record ? 0 : 1;
    wall_time += record ? record->result.wall_time : 0;
  }
  const std::uint64_t done = count - survey.missing;
  if (done > 0) survey.wall_time = wall_time / static_cast<double>(done);
  return survey;
}

std::uint64_t chunk_count(std::uint64_t missing, std::uint64_t length) {
  return (missing + length - 1) / length;
}

std::uint64_t chunk_length(std::uint64_t missing, const ChunkNeeds& needs) {
  const std::uint64_t shortest =
      std::max(needs.side_by_side, chunk_count(missing, needs.most_chunks));
  const std::uint64_t length = std::max(wanted_length(missing, needs), shortest);
  return chunk_count(missing, chunk_count(missing, length));
}

std::vector<CaseRange> chunks(const std::vector<bool>& is_missing, std::uint64_t length) {
  std::vector<CaseRange> ranges;
  std::uint64_t room = 0;  // of the last range
  for (std::uint64_t i = 0; i < is_missing.size(); ++i) {
    if (!is_missing[i]) continue;
    if (room == 0) {
      ranges.push_back({i, i});
      room = length;
    }
    ranges.back().last = i;
    --room;
  }
  return ranges;
}

}  // namespace stride::campaign
