#include "master/cli/listed_cases.h"

#include <iterator>
#include <utility>

#include "master/cli/missing_cases.h"

namespace stride::cli {

ListedCases::ListedCases(const campaign::Plan& origin, const campaign::CampaignScenario& scenario,
                         std::filesystem::path folder, std::size_t jobs)
    : origin_(origin), scenario_(scenario), folder_(std::move(folder)), jobs_(jobs) {}

campaign::Plan ListedCases::make_plan() const {
  campaign::Campaign listed = origin_.campaign();
  std::ranges::move(std::exchange(listed.seeds, {}), std::back_inserter(listed.parameters));
  campaign::ValueTable table;
  for (std::size_t i = 0; i < listed.parameters.size(); ++i) table.parameters.push_back(i);
  for (const ListedRow& row : rows_) table.rows.push_back({.values = row});
  listed.variation = campaign::Deterministic{{std::move(table)}};
  return campaign::Plan(std::move(listed), origin_.kinds(), origin_.fingerprints());
}

bool ListedCases::add(std::vector<ListedRow> rows) {
  const std::uint64_t first = rows_.size();
  std::ranges::move(rows, std::back_inserter(rows_));
  auto plan = std::make_unique<const campaign::Plan>(make_plan());
  const campaign::CaseFolder cases(*plan, folder_);
  const campaign::CaseScratch scratch(cases);
  MissingCases(*plan, scenario_, cases, scratch,
               {.range = {first, rows_.size() - 1}, .jobs = jobs_, .progress = ProgressStyle::None})
      .run();
  std::vector<campaign::CaseResult> results;
  for (std::uint64_t i = first; i < rows_.size(); ++i) {
    auto record = cases.read(i);
    if (!record) break;
    results.push_back(std::move(record->result));
  }
  if (results.size() < rows_.size() - first) {
    rows_.resize(first);
    return false;
  }
  std::ranges::move(results, std::back_inserter(results_));
  plan_ = std::move(plan);
  return true;
}

}  // namespace stride::cli
