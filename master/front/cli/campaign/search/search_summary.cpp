#include "master/front/cli/campaign/search/search_summary.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/front/cli/terminal/table.h"
#include "master/study/search/way.h"

namespace stride::cli {
namespace {

using campaign::CaseMargin;
using campaign::CaseResult;
using campaign::CaseVerdict;

constexpr std::size_t kMostColumns = 6;  ///< of cases

const CaseVerdict* verdict_of(const CaseResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.verdicts, name, &CaseVerdict::name);
  return found == result.verdicts.end() ? nullptr : &*found;
}

std::string margin_text(const std::optional<CaseMargin>& margin) {
  if (!margin) return "";
  return fmt::format("{:.4g}{}{}", margin->value, margin->unit.empty() ? "" : " ", margin->unit);
}

std::string reason_of(const CaseResult& result, const std::string& failure) {
  const CaseVerdict* const verdict = verdict_of(result, failure);
  if (verdict == nullptr) return core::first_line(result.reason);
  if (!verdict->time) return verdict->text;
  const std::string at = fmt::format("at {} s", *verdict->time);
  return verdict->text.empty() ? at : at + ": " + verdict->text;
}

std::string failure_table(const search::Search& search, const ListedCases& cases) {
  Table table({{"failure"}, {"case", Table::Align::Right}, {"because", Table::Align::Left, true}});
  for (const auto& [failure, index] : search.found()) {
    table.add({failure, std::to_string(index), reason_of(cases.result(index), failure)});
  }
  return fmt::format("\nFailures, each by the first case that has it\n{}",
                     table.text(output_width()));
}

/// The case in which the check has its least margin; nothing if it has none in any.
std::optional<std::uint64_t> least_of(const std::string& check, const ListedCases& cases) {
  std::optional<std::uint64_t> least;
  double value = 0;
  for (std::uint64_t i = 0; i < cases.size(); ++i) {
    const CaseVerdict* const verdict = verdict_of(cases.result(i), check);
    if (verdict == nullptr || !verdict->margin) continue;
    if (least && verdict->margin->value >= value) continue;
    least = i;
    value = verdict->margin->value;
  }
  return least;
}

std::string margin_table(const ListedCases& cases) {
  Table table({{"check", Table::Align::Left, true},
               {"in the scenario", Table::Align::Right},
               {"least", Table::Align::Right},
               {"case", Table::Align::Right}});
  for (const CaseVerdict& nominal : cases.result(0).verdicts) {
    const auto least = least_of(nominal.name, cases);
    if (!least) continue;
    table.add({nominal.name, margin_text(nominal.margin),
               margin_text(verdict_of(cases.result(*least), nominal.name)->margin),
               std::to_string(*least)});
  }
  return table.size() == 0 ? "" : fmt::format("\nMargins\n{}", table.text(output_width()));
}

/// Of what was found, or was the nearest to it; the nominal case is in a column of its own.
std::vector<std::uint64_t> shown_cases(const search::Search& search) {
  std::vector<std::uint64_t> shown;
  for (const auto& [failure, index] : search.found()) {
    if (index == 0 || std::ranges::find(shown, index) != shown.end()) continue;
    if (shown.size() < kMostColumns) shown.push_back(index);
  }
  if (search.nearest().value_or(0) != 0) shown.push_back(*search.nearest());
  return shown;
}

std::string parameter_table(const std::vector<std::uint64_t>& shown, const ListedCases& cases,
                            const campaign::CampaignScenario& scenario) {
  const campaign::Plan& plan = cases.plan();
  std::vector<Table::Column> columns{{"parameter"}, {"in the scenario", Table::Align::Right}};
  std::vector<campaign::Case> rows;
  for (const std::uint64_t index : shown) {
    columns.push_back({fmt::format("case {}", index), Table::Align::Right, true});
    rows.push_back(plan.at(index));
  }
  const auto ways = search::ways_of(plan, scenario, plan.at(0).values, 1);
  Table table(std::move(columns));
  for (std::size_t i = 0; i < plan.columns().size(); ++i) {
    std::vector<std::string> fields{parameter_title(plan, scenario, i),
                                    nominal_text(plan.kinds()[i], ways[i].nominal())};
    for (const campaign::Case& row : rows) fields.push_back(row.values[i].value_or(""));
    table.add(std::move(fields));
  }
  return fmt::format("\nParameters\n{}", table.text(output_width()));
}

}  // namespace

std::string parameter_title(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                            std::size_t column) {
  return core::with_unit(plan.columns()[column].parameter.name, scenario.unit_of_measure(column));
}

std::string nominal_text(const campaign::ValueKind& kind, std::optional<double> nominal) {
  return nominal ? number_text(kind, *nominal) : "";
}

std::string search_tables(const search::Search& search, const ListedCases& cases,
                          const campaign::CampaignScenario& scenario) {
  std::string text;
  if (!search.found().empty()) text += failure_table(search, cases);
  text += margin_table(cases);
  const std::vector<std::uint64_t> shown = shown_cases(search);
  if (!shown.empty()) text += parameter_table(shown, cases, scenario);
  text += "\nRepeated by\n";
  if (shown.empty()) text += fmt::format("  0: {}\n", cases.plan().command(cases.plan().at(0)));
  for (const std::uint64_t index : shown) {
    text += fmt::format("  {}: {}\n", index, cases.plan().command(cases.plan().at(index)));
  }
  return text;
}

}  // namespace stride::cli
