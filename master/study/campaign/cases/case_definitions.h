// With which definitions the cases of a campaign have counted their coverage.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_DEFINITIONS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CASES_CASE_DEFINITIONS_H

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "master/observe/coverage/definition.h"
#include "master/study/campaign/cases/case_record.h"

namespace stride::campaign {

/// A case whose units are others may have other bins than the scenario: its definitions are those
/// of its own scenario, which is loaded once for all cases that have the same.
class CaseDefinitions {
 public:
  using Definitions = std::vector<coverage::GroupDefinition>;
  /// Those of a case. Throws core::Error (Input) if its scenario cannot be loaded.
  using Load = std::function<Definitions(std::uint64_t index)>;

  /// There is no coverage.
  CaseDefinitions() = default;
  /// Without `load` the cases with others are not known.
  explicit CaseDefinitions(Definitions of_scenario, Load load = {});

  const Definitions& of_scenario() const { return of_scenario_; }
  /// Those with which this case has counted; null where they cannot be known any more. They stay
  /// where they are.
  const Definitions* of(const CaseCoverage& coverage, std::uint64_t index);

 private:
  Definitions of_scenario_;
  Load load_;
  std::map<std::string, std::optional<Definitions>> by_hash_;
};

}  // namespace stride::campaign

#endif
