#include "master/cli/campaign_search.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "master/campaign/campaign_page.h"
#include "master/campaign/case_table.h"
#include "master/campaign/plan_check.h"
#include "master/campaign/plan_json.h"
#include "master/cli/campaign_input.h"
#include "master/cli/campaign_run.h"
#include "master/cli/interruption.h"
#include "master/cli/listed_cases.h"
#include "master/cli/output.h"
#include "master/cli/progress.h"
#include "master/cli/report_page.h"
#include "master/cli/table.h"
#include "master/recorders/results_folder.h"
#include "master/search/objective.h"
#include "master/search/search_method.h"
#include "master/search/search_space.h"
#include "master/util/error.h"
#include "master/util/input_file.h"
#include "master/util/replacement.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kSearchFile = "search.json";

struct SearchArguments {
  CampaignArguments campaign;
  search::Method method = search::Method::CmaEs;
  std::uint64_t runs = 200;
  std::uint64_t seed = 1;
  std::string check;  ///< empty: all
  bool all = false;   ///< goes on behind the first failure
  std::size_t jobs = 0;
  bool quiet = false;
};

/// A failure that was found, by the first case that has it.
struct Found {
  std::string failure;
  std::uint64_t index = 0;
};

/// What a search was asked for, so that it goes on as the same one.
Json settings_json(const SearchArguments& arguments, const campaign::Plan& plan) {
  return {{"plan", campaign::plan_identity(plan)},
          {"method", search::name(arguments.method)},
          {"seed", arguments.seed},
          {"check", arguments.check},
          {"all", arguments.all}};
}

/// The folder has this search, or none.
void require_same_search(const fs::path& folder, const Json& settings) {
  const fs::path file = folder / kSearchFile;
  if (!core::is_file(file)) return;
  Json before;
  try {
    before = Json::parse(core::read_input(file, "", 64U << 20)).at("settings");
  } catch (const Json::exception&) {
    core::fail_input({.where = {file.string(), 0}}, "this is not what a search has written",
                     "name another folder: --out");
  }
  for (const auto& [name, value] : settings.items()) {
    if (before.contains(name) && before[name] == value) continue;
    core::fail_input({.where = {folder.string(), 0}},
                     fmt::format("this folder belongs to another search: it differs by '{}'", name),
                     "name another folder (--out), or remove this one");
  }
}

class Search {
 public:
  Search(const SearchArguments& arguments, const CampaignInput& input, const fs::path& folder)
      : arguments_(arguments),
        input_(input),
        space_(input.plan().campaign(), input.plan().kinds()),
        method_(arguments.method, space_.dimensions(), arguments.seed),
        cases_(input.plan(), input.scenario(), folder, arguments.jobs),
        form_(Progress::form(arguments.quiet ? ProgressStyle::None : ProgressStyle::Auto)) {}

  /// The nominal case, and then the others. False if it was interrupted.
  bool run() {
    if (!cases_.add({nominal_row()})) return false;
    objective_.emplace(arguments_.check, nominal());
    require_check();
    note(0);
    while (!is_over()) {
      if (!run_generation()) return false;
    }
    return true;
  }

  const ListedCases& cases() const { return cases_; }
  const std::vector<Found>& found() const { return found_; }
  const campaign::CaseResult& nominal() const { return cases_.result(0); }

 private:
  /// Seeds are those of the campaign's first case, so that parameters alone make a difference.
  ListedRow with_seeds(std::vector<campaign::Text> values) const {
    const campaign::Case first = input_.plan().at(0);
    const auto parameters = static_cast<std::ptrdiff_t>(values.size());
    values.insert(values.end(), first.values.begin() + parameters, first.values.end());
    return values;
  }
  ListedRow nominal_row() const {
    return with_seeds(std::vector<campaign::Text>(input_.plan().campaign().parameters.size()));
  }

  void require_check() const {
    if (arguments_.check.empty()) return;
    std::vector<std::string> names;
    for (const auto& verdict : nominal().verdicts) names.push_back(verdict.name);
    if (std::ranges::find(names, arguments_.check) != names.end()) return;
    core::fail_input({}, fmt::format("--check: no check is called '{}'", arguments_.check),
                     fmt::format("its checks are '{}'", fmt::join(names, "', '")));
  }

  bool is_over() const {
    if (cases_.size() >= arguments_.runs) return true;
    if (found_.empty()) return false;
    return !arguments_.all || objective_->is_exhausted(nominal());
  }

  bool run_generation() {
    const std::vector<search::Point> points = method_.ask();
    std::vector<std::uint64_t> indices;
    std::vector<ListedRow> fresh;
    for (const search::Point& point : points) {
      ListedRow row = with_seeds(space_.values(point));
      const std::uint64_t next = cases_.size() + fresh.size();
      const auto [place, is_new] = known_.emplace(row, next);
      if (is_new && next == arguments_.runs) break;  // the budget
      if (is_new) fresh.push_back(std::move(row));
      indices.push_back(place->second);
    }
    const std::uint64_t first = cases_.size();
    if (!fresh.empty() && !cases_.add(std::move(fresh))) return false;
    for (std::uint64_t i = first; i < cases_.size(); ++i) note(i);
    repeated_ = cases_.size() == first ? repeated_ + 1 : 0;
    if (indices.size() == points.size()) tell(indices);
    return true;
  }

  void tell(const std::vector<std::uint64_t>& indices) {
    std::vector<double> values;
    for (const std::uint64_t index : indices) {
      values.push_back(objective_->value(cases_.result(index)));
    }
    method_.tell(values);
  }

  void note(std::uint64_t index) {
    const campaign::CaseResult& result = cases_.result(index);
    least_ = std::min(least_, objective_->value(result));
    for (const std::string& failure : objective_->failures_in(result)) {
      found_.push_back({failure, index});
      if (arguments_.all) objective_->disregard(failure);
    }
    if (form_ == Progress::Form::None) return;
    print_progress(index);
  }

  void print_progress(std::uint64_t index) {
    if (index + 1 != arguments_.runs && (index + 1) % 20 != 0) return;
    fmt::print(stderr, "{} of {} runs, {}\n", index + 1, arguments_.runs,
               found_.empty() ? fmt::format("least margin {:.3g} of the nominal one", least_)
                              : fmt::format("{} found", found_.size()));
  }

  const SearchArguments& arguments_;
  const CampaignInput& input_;
  search::SearchSpace space_;
  search::SearchMethod method_;
  ListedCases cases_;
  Progress::Form form_;
  std::optional<search::Objective> objective_;
  std::map<ListedRow, std::uint64_t> known_;
  std::vector<Found> found_;
  double least_ = std::numeric_limits<double>::infinity();
  int repeated_ = 0;  ///< generations without a new case, one after the other
};

}  // namespace
}  // namespace stride::cli
