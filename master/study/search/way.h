// The ways that shrinking goes: each parameter of a failing case towards its nominal value.
#ifndef STRIDE_MASTER_STUDY_SEARCH_WAY_H
#define STRIDE_MASTER_STUDY_SEARCH_WAY_H

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/value_kind.h"
#include "master/study/campaign/plan.h"

namespace stride::search {

class Way {
 public:
  /// `nominal`: the number that the parameter has where no case gives one; nothing if it is none,
  /// or is not known. `tolerance`: a share of the way, above 0.
  Way(const campaign::ValueKind& kind, std::optional<double> nominal, campaign::Text failing,
      double tolerance);

  /// Whether there are numbers between its ends.
  bool is_continuous() const {
    return nominal_ && number_ && *nominal_ != *number_ && std::isfinite(*nominal_ - *number_);
  }
  /// At 0 none, so that the scenario's own holds; at 1 that of the failing case. Between them a
  /// number with no more digits than the tolerance asks for, of a way that is continuous.
  campaign::Text at(double share) const;

  const std::optional<double>& nominal() const { return nominal_; }
  const std::optional<double>& number() const { return number_; }  ///< of the failing case
  const campaign::ValueKind& kind() const { return kind_; }

 private:
  campaign::ValueKind kind_;
  std::optional<double> nominal_, number_;
  campaign::Text failing_;
  int digits_ = 0;  ///< behind the point; negative: zeros before it
};

/// Those of the parameters of a plan, for a case whose values begin with theirs.
std::vector<Way> ways_of(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                         const std::vector<campaign::Text>& failing, double tolerance);

}  // namespace stride::search

#endif
