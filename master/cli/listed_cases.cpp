#include "master/cli/listed_cases.h"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/cli/missing_cases.h"

namespace stride::cli {
namespace {

/// A record of another case with this index: of another tolerance, say.
void drop_other(const campaign::Plan& plan, const campaign::CaseFolder& cases,
                std::uint64_t index) {
  const auto record = cases.read(index);
  if (!record) return;
  const std::string hash = fmt::format("\"hash\":\"{}\"", plan.hash(plan.at(index)));
  if (record->line.find(hash) != std::string::npos) return;
  std::error_code ignored;  // it is written over then
  std::filesystem::remove(cases.record_file(index), ignored);
}

}  // namespace

search::Row seeds_of(const campaign::Plan& plan, const campaign::Case& row) {
  const auto parameters = static_cast<std::ptrdiff_t>(plan.campaign().parameters.size());
  return {row.values.begin() + parameters, row.values.end()};
}

ListedCases::ListedCases(const campaign::Plan& origin, const campaign::CampaignScenario& scenario,
                         search::Row seeds, std::filesystem::path folder, std::size_t jobs)
    : origin_(origin),
      scenario_(scenario),
      seeds_(std::move(seeds)),
      folder_(std::move(folder)),
      jobs_(jobs) {}

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
  for (std::uint64_t i = first; i < rows_.size(); ++i) drop_other(*plan, cases, i);
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
