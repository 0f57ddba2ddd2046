// The table of a campaign: what became of each case.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_TABLE_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_TABLE_H

#include <cstdint>
#include <optional>
#include <vector>

#include "master/observe/coverage/report.h"
#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

inline constexpr const char* kCaseTable = "cases.csv";
inline constexpr const char* kCaseLines = "cases.jsonl";

/// How many cases have which outcome.
struct CaseTotals {
  std::uint64_t cases = 0;
  std::uint64_t passed = 0;
  std::uint64_t failed = 0;  ///< in whatever way

  void add(Outcome outcome) { ++(outcome == Outcome::Passed ? passed : failed); }
  std::uint64_t done() const { return passed + failed; }
  std::uint64_t missing() const { return cases - done(); }
};

struct FailedCase {
  std::uint64_t index = 0;
  CaseResult result;
};

struct CaseSummary {
  CaseTotals totals;
  std::vector<FailedCase> first_failures{};
  std::optional<coverage::Report> coverage{};  ///< if the scenario declares coverage
  std::uint64_t without_bins = 0;              ///< cases that are not in it: CampaignCoverage
};

/// Reads all records, and writes cases.csv (RFC 4180) and cases.jsonl, a row or a line for each
/// case in order of the index, and coverage.json if the scenario has groups of it; each file is
/// there as a whole or not at all. Needs constant memory, but for the bins. Throws core::Error
/// (Run) if a file cannot be written.
CaseSummary write_case_tables(const Plan& plan, const CaseFolder& cases, const CaseScratch& scratch,
                              std::size_t most_failures, CaseDefinitions coverage = {});

}  // namespace stride::campaign

#endif
