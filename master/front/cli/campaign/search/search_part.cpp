#include "master/front/cli/campaign/search/search_part.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/front/cli/campaign/cases/case_options.h"
#include "master/front/cli/campaign/cases/missing_cases.h"
#include "master/front/cli/campaign/search/search_course.h"
#include "master/front/cli/campaign/search/search_folder.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/study/campaign/evaluation/case_table.h"

namespace stride::cli {
namespace {

using campaign::CaseRange;

[[noreturn]] void refuse_range(const CaseRange& range, const std::string& why) {
  core::fail_input({}, fmt::format("--cases {}: {}", to_text(range), why),
                   "'stride campaign search' with --next prints which cases can be run now");
}

class SearchPart {
 public:
  SearchPart(const SearchArguments& arguments, const CampaignInput& input)
      : arguments_(arguments), input_(input), range_(*arguments.range) {}

  campaign::CaseTotals run() {
    SearchCourse course(arguments_.request, input_,
                        [this](const campaign::Plan& plan, const campaign::CaseFolder& cases,
                               const CaseRange& batch) { return run_batch(plan, cases, batch); });
    course.search.run([](std::uint64_t) {});
    if (!totals_) count(course.cases);
    return *totals_;
  }

 private:
  bool run_batch(const campaign::Plan& plan, const campaign::CaseFolder& cases,
                 const CaseRange& batch) {
    if (range_.last > batch.last) {
      refuse_range(range_, fmt::format("the present generation ends with case {}; the next one "
                                       "depends on what becomes of it",
                                       batch.last));
    }
    begin_search_folder(input_.folder(), arguments_.request, input_.plan());
    drop_others(cases, {std::max(range_.first, batch.first), range_.last});
    const campaign::CaseScratch scratch(cases);
    MissingCases missing(plan, input_.scenario(), cases, scratch,
                         {.range = range_,
                          .jobs = jobs_or_cores(arguments_.jobs),
                          .progress = chosen_style(arguments_.progress, arguments_.quiet)});
    missing.run();
    totals_ = missing.totals();
    return false;
  }

  /// Of a search that is over.
  void count(const ListedCases& cases) {
    if (range_.last >= cases.size()) {
      refuse_range(range_, fmt::format("the search is over with case {}", cases.size() - 1));
    }
    totals_ = {.cases = range_.size()};
    for (std::uint64_t i = range_.first; i <= range_.last; ++i) {
      totals_->add(cases.result(i).outcome);
    }
  }

  const SearchArguments& arguments_;
  const CampaignInput& input_;
  const CaseRange range_;
  std::optional<campaign::CaseTotals> totals_;
};

}  // namespace

void run_search_part(const SearchArguments& arguments, const CampaignInput& input) {
  is_this_search_in(input.folder(), arguments.request, input.plan());
  const Interruption interruption;
  const campaign::CaseTotals totals = SearchPart(arguments, input).run();
  if (!arguments.quiet) {
    print_text("cases {}: {} passed, {} failed, {} missing\n", to_text(*arguments.range),
               totals.passed, totals.failed, totals.missing());
  }
  if (totals.missing() > 0) {
    core::fail_run(
        {}, fmt::format("{} of {} missing", totals.missing(), core::counted(totals.cases, "case")),
        "the same command runs them");
  }
  if (totals.failed > 0) {
    core::fail_run(
        {}, fmt::format("{} of {} failed", totals.failed, core::counted(totals.cases, "case")));
  }
}

void print_next_cases(const SearchArguments& arguments, const CampaignInput& input) {
  is_this_search_in(input.folder(), arguments.request, input.plan());
  const auto print = [](const campaign::Plan&, const campaign::CaseFolder& cases,
                        const CaseRange& batch) {
    for (std::uint64_t i = batch.first; i <= batch.last; ++i) {
      if (!cases.read(i)) print_text("{}\n", i);
    }
    return false;
  };
  SearchCourse(arguments.request, input, print).search.run([](std::uint64_t) {});
}

}  // namespace stride::cli
