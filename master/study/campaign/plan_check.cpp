#include "master/study/campaign/plan_check.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/diagnostics.h"
#include "master/base/message_text.h"
#include "master/base/text/suggest.h"
#include "master/study/campaign/candidate_values.h"

namespace stride::campaign {
namespace {

using Role = PlanColumn::Role;

void check_swap_values(const Plan& plan, const std::vector<CandidateValue>& candidates) {
  core::Diagnostics diagnostics;
  for (const CandidateValue& candidate : candidates) {
    const PlanColumn& column = plan.columns()[candidate.column];
    if (column.role != Role::Swap) continue;
    std::vector<std::string> names;
    const Swap& swap = plan.campaign().swaps[column.item];
    for (const auto& alternative : swap.alternatives) names.push_back(alternative.name);
    if (std::ranges::find(names, candidate.text) != names.end()) continue;
    diagnostics.attempt([&] {
      core::fail_input(
          {.where = candidate.where},
          fmt::format("the swap '{}' has no unit '{}'", swap.name, core::name_text(candidate.text)),
          core::suggestion(candidate.text, names));
    });
  }
  diagnostics.raise();
}

/// A system with start values only is cheap to make, and checks them as a run does.
void check_values(const core::SystemDeclaration& declaration,
                  std::vector<core::StartDeclaration> values) {
  core::SystemDeclaration system = declaration;
  const std::size_t own = system.start_values.size();
  system.start_values.insert(system.start_values.begin() + static_cast<std::ptrdiff_t>(own),
                             std::make_move_iterator(values.begin()),
                             std::make_move_iterator(values.end()));
  const core::System checked(system);
}

/// What is drawn is none of the user's own texts.
template <class Check>
void with_hint_for_draws(Check&& check) {
  try {
    check();
  } catch (const core::Error& mistake) {
    if (mistake.kind() != core::Error::Kind::Input) throw;
    core::fail_input(mistake.context(), mistake.message() + ", which some case has",
                     "limit the distribution by a <Range>");
  }
}

/// In pieces, since a declaration is larger than the text of its value.
void check_start_values(const core::SystemDeclaration& system, const CampaignScenario& scenario,
                        const std::vector<CandidateValue>& candidates) {
  constexpr std::size_t kPiece = 20'000;
  std::vector<core::StartDeclaration> values;
  const auto check = [&] {
    if (!values.empty()) check_values(system, std::exchange(values, {}));
  };
  const auto add = [&](const CandidateValue& candidate) {
    for (const auto& [column, declaration] : scenario.start_targets()) {
      if (column != candidate.column) continue;
      values.push_back(declaration);
      values.back().value = candidate.text;
      values.back().where = candidate.where;
    }
  };
  core::Diagnostics diagnostics;
  for (const CandidateValue& candidate : candidates) {
    if (candidate.is_drawn) continue;
    add(candidate);
    if (values.size() >= kPiece) check();
  }
  diagnostics.attempt(check);
  for (const CandidateValue& candidate : candidates) {
    if (!candidate.is_drawn) continue;
    add(candidate);
    diagnostics.attempt([&] { with_hint_for_draws(check); });
  }
  diagnostics.raise();
}

/// The texts of a case's interventions, of which many may have the same.
std::string intervention_texts(const Plan& plan, const Case& row) {
  std::string texts;
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    if (plan.columns()[i].role != Role::Intervention || !row.values[i]) continue;
    texts += fmt::format("{} {} {} ", i, row.values[i]->size(), *row.values[i]);
  }
  return texts;
}

void check_interventions(const Plan& plan, const CampaignScenario& scenario) {
  if (plan.campaign().interventions.empty()) return;
  const bool vary = std::ranges::any_of(
      plan.columns(), [](const PlanColumn& column) { return column.role == Role::Intervention; });
  constexpr std::size_t kMostKnown = 1'000'000;
  std::set<std::string> known;
  core::Diagnostics diagnostics;
  for (std::uint64_t i = 0; i < (vary ? plan.size() : 1); ++i) {
    const Case row = plan.at(i);
    std::string texts = intervention_texts(plan, row);
    if (known.contains(texts)) continue;
    diagnostics.attempt([&] {
      try {
        scenario.loaded().resolve(plan.request(row).interventions);
      } catch (const core::Error& mistake) {
        if (!vary || mistake.kind() != core::Error::Kind::Input) throw;
        core::fail_input(mistake.context(), fmt::format("{} (case {})", mistake.message(), i),
                         mistake.hint());
      }
    });
    if (known.size() < kMostKnown) known.insert(std::move(texts));
  }
  diagnostics.raise();
}

}  // namespace

void check_plan(const Plan& plan, const CampaignScenario& scenario) {
  const std::vector<CandidateValue> candidates = candidate_values(plan);
  check_swap_values(plan, candidates);
  check_start_values(scenario.loaded().scenario().system, scenario, candidates);
  for (const auto& [swap, name, loaded] : scenario.alternatives()) {
    check_start_values(loaded.scenario().system, scenario, candidates);
  }
  check_interventions(plan, scenario);
}

}  // namespace stride::campaign
