// What became of a case of a campaign.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_RECORD_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_RECORD_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/verdict.h"
#include "master/observe/coverage/report.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

enum class Outcome {
  Passed,
  Failed,    ///< by a check, or a unit's verdict, at the end of a complete run
  Error,     ///< the run did not come to its end
  Crashed,   ///< nor did its process
  TimedOut,  ///< it took longer than the campaign's limit
};
/// As records and tables have it: "timed out".
const char* name(Outcome outcome);

/// core::Margin
struct CaseMargin {
  double value = 0;
  std::string unit;
  double at = 0;  ///< [s]
  bool operator==(const CaseMargin&) const = default;
};

/// A verdict of a check or, where `kind` is empty, of a unit.
struct CaseVerdict {
  std::string name;
  std::string kind;
  std::optional<bool> passed;  ///< empty: undecided
  std::string text;
  std::optional<double> time;          ///< of the first failure [s]
  std::optional<CaseMargin> margin{};  ///< of a check that is decided
  bool operator==(const CaseVerdict&) const = default;
};

const char* verdict_name(std::optional<bool> passed);

/// What a case has covered, by coverage::hash() of the definition.
struct CaseCoverage {
  std::string definition;
  coverage::CoveredBins bins;
  bool operator==(const CaseCoverage&) const = default;
};

/// All but how long it took, when and where, is a function of the plan and the index.
struct CaseResult {
  Outcome outcome = Outcome::Passed;
  std::string reason{};  ///< empty for one that passed
  std::vector<CaseVerdict> verdicts{};
  std::vector<std::optional<double>> aggregates{};  ///< of Campaign::aggregates; empty: none known
  std::optional<CaseCoverage> coverage{};           ///< if the scenario declares coverage
  std::optional<double> reached{};                  ///< simulated time [s]; empty: not known
  bool has_results = false;                         ///< whether all results are kept
  double wall_time = 0;                             ///< [s]
  std::string began{};                              ///< in UTC: "2026-11-25T23:59:59Z"
  std::string host{};                               ///< where
  bool operator==(const CaseResult&) const = default;
};

std::vector<CaseVerdict> case_verdicts(const std::vector<core::Verdict>& verdicts);

/// A line of JSON, without its end: the case, and what became of it. The wall time, when and where
/// stand last.
std::string record_line(const Plan& plan, const Case& row, const CaseResult& result);
/// Likewise of a case that has no record.
std::string missing_line(const Plan& plan, const Case& row);

/// Reads what record_line() has made of the case with this index. Nothing for what is no record of
/// it: half of one, or one of other values (its hash stands for them).
std::optional<CaseResult> parse_record(const Plan& plan, std::uint64_t index,
                                       std::string_view line);

}  // namespace stride::campaign

#endif
