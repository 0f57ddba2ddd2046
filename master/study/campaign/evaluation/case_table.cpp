#include "master/study/campaign/evaluation/case_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/output_file.h"
#include "master/base/message_text.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/merge.h"
#include "master/observe/recorders/signal_text.h"
#include "master/study/campaign/evaluation/campaign_coverage.h"
#include "master/study/campaign/plan_folder.h"

namespace stride::campaign {
namespace {

using recorders::csv_field;

/// A verdict's column, and that of its margin if it is a check's: units and checks may have one
/// name.
struct CheckColumn {
  std::string name;
  bool is_of_unit = false;
  bool operator==(const CheckColumn&) const = default;
};

CheckColumn column_of(const CaseVerdict& verdict) { return {verdict.name, verdict.kind.empty()}; }

std::string number_text(std::optional<double> number) {
  if (!number) return "";
  return std::isnan(*number) ? "nan" : fmt::format("{}", *number);
}

class TableWriter {
 public:
  TableWriter(const Plan& plan, std::vector<CheckColumn> checks, CaseDefinitions& coverage,
              core::OutputFile& file)
      : plan_(plan), checks_(std::move(checks)), coverage_(coverage), file_(file) {}

  void write_header() {
    file_.write("case");
    for (const PlanColumn& column : plan_.columns()) put(csv_field(column.parameter.name));
    put("seed"), put("outcome"), put("reason");
    for (const CheckColumn& check : checks_) {
      put(csv_field((check.is_of_unit ? "verdict:" : "check:") + check.name));
      if (!check.is_of_unit) put(csv_field("margin:" + check.name));
    }
    for (const Aggregate& aggregate : plan_.campaign().aggregates) {
      put(csv_field("aggregate:" + aggregate.name));
    }
    for (const coverage::GroupDefinition& group : coverage_.of_scenario()) {
      put(csv_field("coverage:" + group.name));
    }
    put("reached"), put("hash"), put("wall_time"), put("began"), put("host");
    file_.write('\n');
  }

  /// `result`: null for a case without a record.
  void write_row(const Case& row, const CaseResult* result) {
    static const CaseResult kNothing{};
    const CaseResult& known = result != nullptr ? *result : kNothing;
    file_.write_number(row.index);
    for (const Text& value : row.values) put(value_field(value));
    put(std::to_string(row.seed));
    put(result != nullptr ? name(known.outcome) : "missing");
    put(csv_field(core::first_line(known.reason)));
    for (const CheckColumn& check : checks_) put_verdict(known, check);
    for (std::size_t i = 0; i < plan_.campaign().aggregates.size(); ++i) {
      put(i < known.aggregates.size() ? number_text(known.aggregates[i]) : "");
    }
    if (!coverage_.of_scenario().empty()) put_coverage(known, row.index);
    put(number_text(known.reached));
    put(plan_.hash(row));
    put(result != nullptr ? number_text(known.wall_time) : "");
    put(known.began);
    put(csv_field(known.host));
    file_.write('\n');
  }

 private:
  void put(const std::string& field) {
    file_.write(',');
    file_.write(field);
  }

  void put_verdict(const CaseResult& result, const CheckColumn& check) {
    const auto found = std::ranges::find(result.verdicts, check, column_of);
    const bool is_known = found != result.verdicts.end();
    put(is_known ? verdict_name(found->passed) : "");
    if (check.is_of_unit) return;
    put(is_known && found->margin ? number_text(found->margin->value) : "");
  }

  /// The groups are those of the scenario, whatever the units are.
  void put_coverage(const CaseResult& result, std::uint64_t index) {
    std::vector<std::optional<double>> percentages(coverage_.of_scenario().size());
    const auto* const own = result.coverage ? coverage_.of(*result.coverage, index) : nullptr;
    if (own != nullptr) percentages = coverage::percentages(*own, result.coverage->bins);
    for (const auto& percentage : percentages) put(number_text(percentage));
  }

  const Plan& plan_;
  std::vector<CheckColumn> checks_;
  CaseDefinitions& coverage_;
  core::OutputFile& file_;
};

/// In the order in which they appear, by the index.
void add_columns(const CaseResult& result, std::vector<CheckColumn>& columns) {
  for (const CaseVerdict& verdict : result.verdicts) {
    CheckColumn column = column_of(verdict);
    if (std::ranges::find(columns, column) == columns.end()) columns.push_back(std::move(column));
  }
}

}  // namespace

CaseSummary write_case_tables(const Plan& plan, const CaseFolder& cases, const CaseScratch& scratch,
                              std::size_t most_failures, CaseDefinitions coverage) {
  CaseSummary summary{.totals = {.cases = plan.size()}};
  CampaignCoverage covered(plan, coverage);
  std::vector<CheckColumn> columns;
  core::OutputFile lines(scratch.file(kCaseLines));
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    auto record = cases.read(i);
    lines.write(record ? record->line : missing_line(plan, plan.at(i)));
    lines.write('\n');
    if (!record) continue;
    summary.totals.add(record->result.outcome);
    add_columns(record->result, columns);
    covered.add(record->result, i);
    if (record->result.outcome == Outcome::Passed) continue;
    if (summary.first_failures.size() == most_failures) continue;
    summary.first_failures.push_back({i, std::move(record->result)});
  }
  lines.close();
  summary.coverage = covered.report();
  summary.without_bins = covered.unknown();
  core::OutputFile table(scratch.file(kCaseTable));
  TableWriter writer(plan, std::move(columns), coverage, table);
  writer.write_header();
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const auto record = cases.read(i);
    writer.write_row(plan.at(i), record ? &record->result : nullptr);
  }
  table.close();
  scratch.publish(kCaseLines);
  scratch.publish(kCaseTable);
  if (!summary.coverage) return summary;
  coverage::write_coverage(scratch.file(coverage::kCoverageFile), *summary.coverage);
  scratch.publish(coverage::kCoverageFile);
  return summary;
}

}  // namespace stride::campaign
