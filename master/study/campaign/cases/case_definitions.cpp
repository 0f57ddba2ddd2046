#include "master/study/campaign/cases/case_definitions.h"

#include <utility>

#include "master/base/error.h"

namespace stride::campaign {

CaseDefinitions::CaseDefinitions(Definitions of_scenario, Load load)
    : of_scenario_(std::move(of_scenario)), load_(std::move(load)) {
  by_hash_.emplace(coverage::hash(of_scenario_), of_scenario_);
}

/// The files may have changed since the case ran.
const CaseDefinitions::Definitions* CaseDefinitions::of(const CaseCoverage& coverage,
                                                        std::uint64_t index) {
  const auto [known, is_new] = by_hash_.try_emplace(coverage.definition);
  if (is_new && load_) {
    try {
      Definitions loaded = load_(index);
      if (coverage::hash(loaded) == coverage.definition) known->second = std::move(loaded);
    } catch (const core::Error& mistake) {
      if (mistake.kind() != core::Error::Kind::Input) throw;
    }
  }
  return known->second ? &*known->second : nullptr;
}

}  // namespace stride::campaign
