// The scenario of a campaign, loaded once: what its parameters are.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_CAMPAIGN_SCENARIO_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_CAMPAIGN_SCENARIO_H

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/base/files/file_digests.h"
#include "master/engine/model/system/connector_elements.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/value_kind.h"
#include "master/study/campaign/fingerprints.h"
#include "master/study/campaign/plan.h"
#include "master/system/plan/run_plan.h"

namespace stride::campaign {

class CampaignScenario {
 public:
  /// Loads the scenario with its units, of which none is instantiated, and the alternatives of
  /// swaps. Throws core::Error (Input) for what they and the names of the campaign have wrong:
  /// unknown components, variables and signals, parameters that name the same variable, and
  /// parameters without effect. `version` is that of stride; `units` need not be loaded.
  CampaignScenario(const Campaign& campaign, const std::string& version,
                   scenario::UnitStore units = {});

  /// A start value that a column gives; a connector of the system may lead to several.
  struct StartTarget {
    std::size_t column = 0;
    core::StartDeclaration declaration;
  };
  /// The scenario with another unit in the place of a component's.
  struct LoadedAlternative {
    std::size_t swap = 0;
    std::string name;
    scenario::RunPlan loaded;
  };

  const scenario::RunPlan& loaded() const { return loaded_; }
  /// All units, those of alternatives, too.
  const std::shared_ptr<scenario::UnitStore>& units() const { return units_; }
  const std::vector<StartTarget>& start_targets() const { return targets_; }
  const std::vector<LoadedAlternative>& alternatives() const { return alternatives_; }
  /// Of the columns of the campaign's plan.
  const std::vector<ValueKind>& kinds() const { return kinds_; }
  /// The number that a start value has where the case gives none: of the scenario, or else of the
  /// unit. Nothing for what is no number, and for a connector whose value is another one than its
  /// variable's.
  std::optional<double> scenario_value(std::size_t column) const;
  /// In which a start value is given; empty if it has none.
  std::string unit_of_measure(std::size_t column) const;
  const Fingerprints& fingerprints() const { return fingerprints_; }
  /// Of the files that the fingerprints are made of.
  const core::FileDigests& digests() const { return digests_; }

 private:
  void check_names(const Campaign& campaign) const;
  void find_start_targets(const Campaign& campaign, const std::vector<PlanColumn>& columns);
  std::vector<core::ConnectorElements> elements_of(std::size_t column) const;
  void check_effects(const std::vector<PlanColumn>& columns) const;
  void find_kinds(const Campaign& campaign, const std::vector<PlanColumn>& columns);
  ValueKind start_kind(std::size_t column) const;
  ValueKind part_kind(const NamedIntervention& intervention, const std::string& part) const;
  ValueKind seed_kind(std::size_t column, const Parameter& seed) const;
  void check_aggregates(const Campaign& campaign) const;
  void check_captures(const Campaign& campaign) const;
  void load_alternatives(const Campaign& campaign);
  void take_fingerprints(const Campaign& campaign);

  std::shared_ptr<scenario::UnitStore> units_;
  scenario::RunPlan loaded_;
  core::NameIndex names_;
  std::vector<StartTarget> targets_;
  std::vector<ValueKind> kinds_;
  std::vector<LoadedAlternative> alternatives_;
  core::FileDigests digests_;
  Fingerprints fingerprints_;
};

}  // namespace stride::campaign

#endif
