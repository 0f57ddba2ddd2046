// The table of cases of a campaign: which settings, and which seed, each case has.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_PLAN_H

#include <cstdint>
#include <string>
#include <vector>

#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/value_kind.h"
#include "master/study/campaign/fingerprints.h"
#include "master/study/campaign/sampling.h"
#include "master/system/plan/request.h"

namespace stride::campaign {

/// A row of the table.
struct Case {
  std::uint64_t index = 0;
  std::vector<Text> values;  ///< one for each of Plan::columns()
  std::uint64_t seed = 0;    ///< of random_seed and the index alone
};

/// A column of the table, and what its values are for.
struct PlanColumn {
  enum class Role { Start, Swap, Intervention };
  Parameter parameter;
  Role role = Role::Start;
  std::size_t item = 0;  ///< of Campaign::swaps or interventions
  std::string part;      ///< of an intervention: "from"
};

/// The columns that a campaign's table has: those of its parameters, and then of its seeds. Throws
/// core::Error (Input) for a part that an intervention does not have.
std::vector<PlanColumn> plan_columns(const Campaign& campaign);

/// A plan is immutable and of constant size, however many cases it has. Each case is a function of
/// its index, so it may be asked for in any order, by any number of threads and in any process.
class Plan {
 public:
  /// `kinds` are those of the columns. Throws core::Error (Input) for what no such kind can have,
  /// for a campaign without cases, and for one with more than kMostCases.
  Plan(Campaign campaign, std::vector<ValueKind> kinds, Fingerprints fingerprints);

  static constexpr std::uint64_t kMostCases = 10'000'000;

  const Campaign& campaign() const { return campaign_; }
  const std::vector<PlanColumn>& columns() const { return columns_; }
  const std::vector<ValueKind>& kinds() const { return kinds_; }
  const Fingerprints& fingerprints() const { return fingerprints_; }
  std::uint64_t size() const { return size_; }

  /// The row of this index, which is below size().
  Case at(std::uint64_t index) const;

  /// What a run of the case is to be asked for: `scenario`, `parameters`, `swaps` and
  /// `interventions`, which are there whether they vary or not. Throws core::Error (Input) where
  /// the text of a part of an intervention is wrong; after check_plan() there is none.
  scenario::ScenarioRequest request(const Case& row) const;
  /// What repeats the case: the words behind `stride`, and all of it, ready for a shell.
  std::vector<std::string> words(const Case& row) const;
  std::string command(const Case& row) const;

  /// 64 hexadecimal digits that stand for all that decides the result of the case: version, files
  /// of the scenario, units, settings. Its index does not.
  std::string hash(const Case& row) const;

 private:
  std::vector<scenario::InterventionDeclaration> interventions(const Case& row) const;
  const Swap::Alternative* alternative(const Case& row, std::size_t column) const;
  void add_combination(const Deterministic& variation, Case& row) const;
  void add_draws(const Stochastic& variation, Case& row) const;

  Campaign campaign_;
  std::vector<PlanColumn> columns_;
  std::vector<ValueKind> kinds_;
  Fingerprints fingerprints_;
  std::uint64_t key_;  ///< of the random numbers
  std::uint64_t size_ = 0;
  Sampling sampling_;
};

}  // namespace stride::campaign

#endif
