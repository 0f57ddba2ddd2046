#include "master/front/cli/campaign/search/listed_cases.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/front/cli/campaign/cases/missing_cases.h"

namespace stride::cli {

void drop_others(const campaign::CaseFolder& cases, const campaign::CaseRange& range) {
  for (std::uint64_t i = range.first; i <= range.last; ++i) {
    if (cases.read(i)) continue;
    std::error_code ignored;  // it is written over then
    std::filesystem::remove(cases.record_file(i), ignored);
  }
}

RunBatch local_batches(const campaign::CampaignScenario& scenario, std::size_t jobs) {
  return [&scenario, jobs](const campaign::Plan& plan, const campaign::CaseFolder& cases,
                           const campaign::CaseRange& batch) {
    drop_others(cases, batch);
    const campaign::CaseScratch scratch(cases);
    MissingCases(plan, scenario, cases, scratch,
                 {.range = batch, .jobs = jobs, .progress = ProgressStyle::None})
        .run();
    return true;
  };
}

search::Row seeds_of(const campaign::Plan& plan, const campaign::Case& row) {
  const auto parameters = static_cast<std::ptrdiff_t>(plan.campaign().parameters.size());
  return {row.values.begin() + parameters, row.values.end()};
}

ListedCases::ListedCases(const campaign::Plan& origin, search::Row seeds,
                         std::filesystem::path folder, RunBatch run)
    : origin_(origin), seeds_(std::move(seeds)), folder_(std::move(folder)), run_(std::move(run)) {}

campaign::Plan ListedCases::make_plan() const {
  campaign::Campaign listed = origin_.campaign();
  std::ranges::move(std::exchange(listed.seeds, {}), std::back_inserter(listed.parameters));
  campaign::ValueTable table;
  for (std::size_t i = 0; i < listed.parameters.size(); ++i) table.parameters.push_back(i);
  for (const search::Row& row : rows_) table.rows.push_back({.values = row});
  listed.variation = campaign::Deterministic{{std::move(table)}};
  return campaign::Plan(std::move(listed), origin_.kinds(), origin_.fingerprints());
}

bool ListedCases::add(std::vector<search::Row> rows) {
  const std::uint64_t first = rows_.size();
  for (search::Row& row : rows) {
    row.insert(row.end(), seeds_.begin(), seeds_.end());
    rows_.push_back(std::move(row));
  }
  auto plan = std::make_unique<const campaign::Plan>(make_plan());
  const campaign::CaseFolder cases(*plan, folder_);
  if (!take_results(cases) &&
      (!run_(*plan, cases, {first, rows_.size() - 1}) || !take_results(cases))) {
    rows_.resize(first);
    return false;
  }
  plan_ = std::move(plan);
  return true;
}

/// Of the new rows, if all are there.
bool ListedCases::take_results(const campaign::CaseFolder& cases) {
  std::vector<campaign::CaseResult> results;
  for (std::uint64_t i = results_.size(); i < rows_.size(); ++i) {
    auto record = cases.read(i);
    if (!record) return false;
    results.push_back(std::move(record->result));
  }
  std::ranges::move(results, std::back_inserter(results_));
  return true;
}

}  // namespace stride::cli
