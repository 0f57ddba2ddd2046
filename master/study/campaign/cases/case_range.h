// Some of the cases of a campaign, one after the other.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_RANGE_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_RANGE_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stride::campaign {

/// The cases from `first` to `last`, both of them.
struct CaseRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  std::uint64_t size() const { return last - first + 1; }
  bool operator==(const CaseRange&) const = default;
};

/// "20-29", or "20".
std::string to_text(const CaseRange& range);
/// Digits only, as "17" or "000017", below Plan::kMostCases; nothing for anything else.
std::optional<std::uint64_t> parse_case_index(std::string_view text);
/// Reads what to_text() makes; nothing if it is none, or the first case comes after the last one.
std::optional<CaseRange> parse_case_range(std::string_view text);

}  // namespace stride::campaign

#endif
