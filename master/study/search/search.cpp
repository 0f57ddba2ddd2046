#include "master/study/search/search.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"

namespace stride::search {
namespace {

/// Of few values all combinations may be known.
constexpr int kMostGenerationsWithoutCase = 100;

}  // namespace

Search::Search(const Request& request, const SearchSpace& space, Cases& cases)
    : request_(request), space_(space), cases_(cases) {
  begin_method();
}

/// Again for each failure that is disregarded, which makes the function another one.
void Search::begin_method() {
  method_.emplace(request_.method, space_.dimensions(), request_.seed + found_.size(),
                  request_.make_optimiser);
}

bool Search::run(const std::function<void(std::uint64_t index)>& on_case) {
  const Row nominal = space_.nominal();
  if (!cases_.add({nominal})) return false;
  known_.emplace(nominal, 0);
  const campaign::CaseResult& result = cases_.result(0);
  if (!came_to_its_end(result)) {
    found_.push_back({name(result.outcome), 0});
    on_case(0);
    return true;
  }
  objective_.emplace(request_.check, result);
  require_check();
  note(0);
  on_case(0);
  while (!is_over()) {
    if (!run_generation(on_case)) return false;
  }
  return true;
}

void Search::require_check() const {
  std::vector<std::string> names;
  for (const auto& verdict : cases_.result(0).verdicts) names.push_back(verdict.name);
  const std::string& check = request_.check;
  if (check.empty() || std::ranges::find(names, check) != names.end()) return;
  core::fail_input({}, fmt::format("no check is called '{}'", check),
                   fmt::format("the checks are '{}'", fmt::join(names, "', '")));
}

bool Search::is_over() const {
  if (cases_.size() >= request_.runs) return true;
  if (generations_without_case_ > kMostGenerationsWithoutCase) return true;
  if (found_.empty()) return false;
  return !request_.finds_all || objective_->is_exhausted(cases_.result(0));
}

bool Search::run_generation(const std::function<void(std::uint64_t index)>& on_case) {
  const std::uint64_t first = cases_.size();
  std::vector<std::uint64_t> indices;
  std::vector<Row> rows;
  for (const Point& point : method_->ask()) {
    Row row = space_.values(point);
    const auto [place, is_new] = known_.emplace(row, first + rows.size());
    if (is_new) rows.push_back(std::move(row));
    indices.push_back(place->second);
  }
  const bool is_last = first + rows.size() >= request_.runs;
  rows.resize(std::min<std::size_t>(rows.size(), request_.runs - first));
  generations_without_case_ = rows.empty() ? generations_without_case_ + 1 : 0;
  if (!rows.empty() && !cases_.add(std::move(rows))) return false;
  const std::size_t found_before = found_.size();
  for (std::uint64_t i = first; i < cases_.size(); ++i) {
    note(i);
    on_case(i);
  }
  if (is_last) return true;
  if (found_.size() > found_before) {
    begin_method();
    return true;
  }
  std::vector<double> values;
  for (const std::uint64_t index : indices) {
    values.push_back(objective_->value(cases_.result(index)));
  }
  method_->tell(values);
  return true;
}

void Search::note(std::uint64_t index) {
  const campaign::CaseResult& result = cases_.result(index);
  const double value = objective_->value(result);
  if (found_.empty() && value < least_) {
    least_ = value;
    nearest_ = index;
  }
  for (const std::string& failure : objective_->failures_in(result)) {
    found_.push_back({failure, index});
    objective_->disregard(failure);
    nearest_.reset();
  }
}

}  // namespace stride::search
