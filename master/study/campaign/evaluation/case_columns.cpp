#include "master/study/campaign/evaluation/case_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "master/study/campaign/evaluation/campaign_coverage.h"
#include "master/study/campaign/random.h"

namespace stride::campaign {
namespace {

static_assert(static_cast<std::uint8_t>(Outcome::TimedOut) + 1 == kMissing);

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The first index that was not taken yet, of blocks of equal size.
class Choice {
 public:
  Choice(std::uint64_t size, std::uint64_t most)
      : size_(size), taken_(std::min(size, most)), next_(place_in(0)) {}

  bool takes(std::uint64_t index) {
    if (index != next_) return false;
    if (++block_ < taken_) next_ = place_in(block_);
    return true;
  }

 private:
  std::uint64_t place_in(std::uint64_t block) const {
    const std::uint64_t first = block * size_ / taken_;
    const std::uint64_t count = (block + 1) * size_ / taken_ - first;
    return first + stream_.bits(block) % count;
  }

  RandomStream stream_{0, "shown cases"};
  std::uint64_t size_, taken_, block_ = 0;
  std::uint64_t next_;
};

void count_checks(const CaseResult& result, std::vector<CheckCounts>& checks) {
  for (const CaseVerdict& verdict : result.verdicts) {
    auto found = std::ranges::find_if(checks, [&](const CheckCounts& check) {
      return check.name == verdict.name && check.kind == verdict.kind;
    });
    if (found == checks.end()) {
      found = checks.insert(checks.end(), {.name = verdict.name, .kind = verdict.kind});
    }
    ++(!verdict.passed ? found->undecided : *verdict.passed ? found->passed : found->failed);
  }
}

double first_failure(const CaseResult& result) {
  double first = kUnknown;
  for (const CaseVerdict& verdict : result.verdicts) {
    if (verdict.passed.value_or(true) || !verdict.time) continue;
    first = std::isnan(first) ? *verdict.time : std::min(first, *verdict.time);
  }
  return first;
}

void add_to_all(const CaseResult& result, CaseColumns& columns) {
  columns.wall_time += result.wall_time;
  std::string& first = columns.first_began;
  if (first.empty() || result.began < first) first = result.began;
  columns.last_began = std::max(columns.last_began, result.began);
  ++columns.cases_on[result.host];
  count_checks(result, columns.checks);
}

/// Of the last case that was taken; a check that appears late has none before.
void add_margins(const CaseResult& result, CaseColumns& columns) {
  const std::size_t count = columns.size();
  for (const CaseVerdict& verdict : result.verdicts) {
    if (!verdict.margin) continue;
    auto found = std::ranges::find(columns.margins, verdict.name, &MarginColumn::name);
    if (found == columns.margins.end()) {
      found = columns.margins.insert(found, {verdict.name, verdict.margin->unit, {}});
    }
    found->values.resize(count, kUnknown);
    found->values.back() = verdict.margin->value;
  }
  for (MarginColumn& column : columns.margins) column.values.resize(count, kUnknown);
}

void add_values(const Case& row, CaseColumns& columns) {
  for (std::size_t i = 0; i < columns.parameters.size(); ++i) {
    columns.parameters[i].texts.push_back(row.values[i].value_or(kScenarioValue));
  }
}

void add_result(const CaseResult* result, CaseColumns& columns) {
  static const CaseResult kNothing{};
  const CaseResult& known = result != nullptr ? *result : kNothing;
  const bool is_known = result != nullptr;
  columns.outcomes.push_back(is_known ? static_cast<std::uint8_t>(known.outcome) : kMissing);
  for (std::size_t i = 0; i < columns.aggregates.size(); ++i) {
    columns.aggregates[i].push_back(
        i < known.aggregates.size() ? known.aggregates[i].value_or(kUnknown) : kUnknown);
  }
  add_margins(known, columns);
  columns.reached.push_back(known.reached.value_or(kUnknown));
  columns.wall_times.push_back(is_known ? known.wall_time : kUnknown);
  columns.failed_at.push_back(first_failure(known));
  columns.has_results.push_back(known.has_results ? 1 : 0);
  columns.reasons.push_back(known.reason);
  columns.began.push_back(known.began);
  columns.hosts.push_back(known.host);
}

/// If all of its values are numbers; names of units never are.
void become_numbers(ParameterColumn& column, const ValueKind& kind) {
  if (kind.type == ValueKind::Type::Text) return;
  std::vector<double> numbers;
  for (const std::string& text : column.texts) {
    const auto number = text == kScenarioValue ? kUnknown : number_of(text);
    if (!number) return;
    numbers.push_back(*number);
  }
  column.is_number = true;
  column.numbers = std::move(numbers);
  column.texts.clear();
}

}  // namespace

CaseColumns read_case_columns(const Plan& plan, const CaseFolder& cases, std::uint64_t most,
                              CaseDefinitions coverage) {
  CaseColumns columns;
  CampaignCoverage covered(plan, coverage);
  for (const Parameter& parameter : plan.campaign().parameters) {
    columns.parameters.push_back({.name = parameter.name, .numbers = {}, .texts = {}});
  }
  columns.aggregates.resize(plan.campaign().aggregates.size());
  Choice choice(plan.size(), most);
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const auto record = cases.read(i);
    const CaseResult* const result = record ? &record->result : nullptr;
    ++columns.counts[result != nullptr ? static_cast<std::size_t>(result->outcome) : kMissing];
    if (result != nullptr) {
      add_to_all(*result, columns);
      covered.add(*result, i);
    }
    if (!choice.takes(i)) continue;
    columns.indices.push_back(static_cast<std::int32_t>(i));
    add_values(plan.at(i), columns);
    add_result(result, columns);
  }
  for (std::size_t i = 0; i < columns.parameters.size(); ++i) {
    become_numbers(columns.parameters[i], plan.kinds()[i]);
  }
  columns.coverage = covered.report();
  return columns;
}

}  // namespace stride::campaign
