// The records of a campaign, column by column.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_COLUMNS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_CASE_COLUMNS_H

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "master/observe/coverage/report.h"
#include "master/study/campaign/cases/case_definitions.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/plan.h"

namespace stride::campaign {

/// In place of an outcome: there is no record. Behind all of Outcome.
inline constexpr std::uint8_t kMissing = 5;
inline constexpr std::size_t kOutcomeKinds = 6;

/// A parameter of the campaign that is no seed.
struct ParameterColumn {
  std::string name;
  bool is_number = false;
  std::vector<double> numbers;     ///< of one that is; NaN where the scenario's value holds
  std::vector<std::string> texts;  ///< of one that is not; likewise kScenarioValue
};
inline constexpr const char* kScenarioValue = "(as in the scenario)";

/// How often a check, or the verdict of a unit, came to which end.
struct CheckCounts {
  std::string name;
  std::string kind;  ///< empty: of a unit
  std::uint64_t passed = 0, failed = 0, undecided = 0;
};

/// The margins of a check.
struct MarginColumn {
  std::string name;  ///< of the check
  std::string unit;
  std::vector<double> values;  ///< NaN where it is undecided or not known
};

/// Vectors have an element for each case that was taken; what is not known is NaN.
struct CaseColumns {
  std::vector<std::int32_t> indices;   ///< ascending
  std::vector<std::uint8_t> outcomes;  ///< an Outcome, or kMissing
  std::vector<ParameterColumn> parameters;
  std::vector<std::vector<double>> aggregates;  ///< of Campaign::aggregates
  std::vector<MarginColumn> margins;            ///< in the order in which they appear
  std::vector<double> reached, wall_times;      ///< [s]
  std::vector<double> failed_at;                ///< the first instant of a failure [s]
  std::vector<std::uint8_t> has_results;
  std::vector<std::string> reasons;
  std::vector<std::string> began, hosts;  ///< as records have them

  // of all cases
  std::array<std::uint64_t, kOutcomeKinds> counts{};  ///< by outcomes
  std::vector<CheckCounts> checks;                    ///< in the order in which they appear
  double wall_time = 0;                               ///< the sum [s]
  std::string first_began, last_began;                ///< empty: none has
  std::map<std::string, std::uint64_t> cases_on;      ///< by hosts
  std::optional<coverage::Report> coverage;           ///< if the scenario declares some

  std::size_t size() const { return indices.size(); }
};

/// Reads all records. Of more than `most` cases it takes so many, one from each of as many blocks
/// of equal size, chosen by random numbers that are the same each time: no pattern of the plan
/// shows in them.
CaseColumns read_case_columns(const Plan& plan, const CaseFolder& cases, std::uint64_t most,
                              CaseDefinitions coverage = {});

}  // namespace stride::campaign

#endif
