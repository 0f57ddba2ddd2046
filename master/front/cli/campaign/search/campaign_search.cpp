#include "master/front/cli/campaign/search/campaign_search.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/text/counted.h"
#include "master/base/text/suggest.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/cases/campaign_progress.h"
#include "master/front/cli/campaign/cases/case_options.h"
#include "master/front/cli/campaign/cases/missing_cases.h"
#include "master/front/cli/campaign/search/listed_cases.h"
#include "master/front/cli/campaign/search/search_course.h"
#include "master/front/cli/campaign/search/search_folder.h"
#include "master/front/cli/campaign/search/search_jobs.h"
#include "master/front/cli/campaign/search/search_options.h"
#include "master/front/cli/campaign/search/search_part.h"
#include "master/front/cli/campaign/search/search_summary.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan_check.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/search/objective.h"
#include "master/study/search/search.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

/// The campaign itself, and the folder of the search.
CampaignArguments searched(const CampaignArguments& named) {
  const bool is_folder = core::is_folder(named.file);
  const fs::path file = is_folder ? campaign::campaign_of(named.file) : named.file;
  return {file, named.out.empty() ? default_search_folder(file) : named.out};
}

/// A search through a campaign, in its folder, which is locked.
class CampaignSearch {
 public:
  CampaignSearch(const SearchArguments& arguments, const CampaignInput& input)
      : arguments_(arguments),
        input_(input),
        course_(arguments.request, input, runner()),
        totals_{.cases = arguments.request.runs},
        progress_(chosen_style(arguments.progress, arguments.quiet), totals_) {}

  void run() {
    const bool is_complete = search_.run([&](std::uint64_t index) { show(index); });
    progress_.end(totals_, is_complete ? "completed" : "interrupted");
    if (cases_.size() > 0) {
      write_tables();
      if (!arguments_.quiet) print();
    }
    if (!is_complete) fail_incomplete();
    if (!search_.found().empty()) fail();
  }

 private:
  RunBatch runner() {
    if (arguments_.cluster.cluster.empty()) {
      return local_batches(input_.scenario(), jobs_or_cores(arguments_.jobs));
    }
    jobs_.emplace(arguments_, input_, [this](const std::string& what) { show_waiting(what); });
    return [this](const campaign::Plan& plan, const campaign::CaseFolder& cases,
                  const campaign::CaseRange& batch) { return jobs_->run(plan, cases, batch); };
  }

  void show_waiting(const std::string& what) { progress_.show(totals_, "waiting for " + what); }

  void show(std::uint64_t index) {
    totals_.add(cases_.result(index).outcome);
    if (!search::came_to_its_end(cases_.result(index))) ++without_end_;
    const std::size_t found = search_.found().size();
    progress_.show(totals_, found == 0 ? "" : core::counted(found, "failure") + " found");
  }

  void write_tables() const {
    const campaign::CaseFolder folder(cases_.plan(), cases_.folder());
    const campaign::CaseScratch scratch(folder);
    write_case_tables(cases_.plan(), folder, scratch, 0);
  }

  void print() const {
    const search::Request& request = arguments_.request;
    const std::size_t found = search_.found().size();
    print_text("{}: {} found in {} by {}, seed {}{}\n",
               input_.plan().campaign().file.stem().string(),
               found == 0 ? "no failure" : core::counted(found, "failure"),
               core::counted(cases_.size(), "case"), search::name(request.method), request.seed,
               request.check.empty() ? "" : fmt::format(", of the check '{}'", request.check));
    print_text("{}", search_tables(search_, cases_, input_.scenario()));
    if (!request.check.empty() && without_end_ > 0) {
      print_text("\n{} of the cases did not come to their end, which is no failure of this check\n",
                 without_end_);
    }
    print_text("\nTable in {}: {} {} {}\n", cases_.folder().string(), campaign::kCaseTable,
               campaign::kCaseLines, campaign::kSearchDescription);
    if (jobs_) print_text("Scripts and log files in {}\n", jobs_->folder().string());
  }

  [[noreturn]] void fail_incomplete() const {
    if (jobs_) jobs_->require_records();
    const std::string left = jobs_ ? jobs_->left() : "";
    core::fail_run(
        {},
        fmt::format("the search {}; {} of at most {} cases are done",
                    MissingCases::is_interrupted()
                        ? "was interrupted"
                        : "cannot go on: somebody has removed records from its folder",
                    cases_.size(), arguments_.request.runs),
        left.empty() ? "it goes on with the same command"
                     : left + " is in the queue still; the same command waits for it, and goes on");
  }

  [[noreturn]] void fail() const {
    const auto& [failure, index] = search_.found().front();
    if (index == 0) {
      core::fail_run(
          {},
          fmt::format("the scenario itself fails, without any value of the campaign: {}", failure),
          fmt::format("repeat it with: {}", cases_.plan().command(cases_.plan().at(0))));
    }
    core::fail_run({},
                   fmt::format("{} found, the first one in case {}: {}",
                               core::counted(search_.found().size(), "failure"), index, failure),
                   fmt::format("see what of it is needed: stride campaign shrink {} --case {}",
                               cases_.folder().string(), index));
  }

  const SearchArguments& arguments_;
  const CampaignInput& input_;
  std::optional<SearchJobs> jobs_;
  SearchCourse course_;
  const ListedCases& cases_ = course_.cases;
  search::Search& search_ = course_.search;
  campaign::CaseTotals totals_;
  CampaignProgress progress_;
  std::uint64_t without_end_ = 0;  ///< cases
};

void run_search(const SearchArguments& arguments, const CampaignInput& input) {
  begin_search_folder(input.folder(), arguments.request, input.plan());
  const recorders::ResultsLock lock(input.folder());
  const Interruption interruption;
  CampaignSearch(arguments, input).run();
}

void print_script(const SearchArguments& arguments, const CampaignInput& input) {
  is_this_search_in(input.folder(), arguments.request, input.plan());
  const SearchJobs jobs(arguments, input, [](const std::string&) {});
  const auto print = [&](const campaign::Plan&, const campaign::CaseFolder& cases,
                         const campaign::CaseRange& batch) {
    print_text("{}", jobs.script(cases, batch));
    return false;
  };
  SearchCourse course(arguments.request, input, print);
  if (!course.search.run([](std::uint64_t) {})) return;
  print_text("{}: the search is over with {}, and nothing is submitted\n",
             input.plan().campaign().file.stem().string(),
             core::counted(course.cases.size(), "case"));
}

void search_campaign(SearchArguments arguments) {
  const CrashGuard guard;
  arguments.campaign = searched(arguments.campaign);
  const CampaignInput input(arguments.campaign);
  using namespace campaign;
  input.refuse_inputs({kSearchDescription, kCaseTable, kCaseLines, kCases, kRunning});
  if (!arguments.cluster.cluster.empty()) input.refuse_inputs({arguments.cluster.cluster.c_str()});
  require_check(input.scenario(), arguments.request.check);
  check_plan(input.plan(), input.scenario());
  if (arguments.request.method != search::Method::Random) {
    arguments.request.make_optimiser = &search::load_optimisers(search::optimiser_library());
  }
  if (arguments.range) return run_search_part(arguments, input);
  if (arguments.lists_next) return print_next_cases(arguments, input);
  if (arguments.is_dry) return print_script(arguments, input);
  run_search(arguments, input);
}

}  // namespace

void require_check(const campaign::CampaignScenario& scenario, const std::string& name) {
  const auto& checks = scenario.loaded().checks();
  if (checks.empty()) {
    core::fail_input({.where = {scenario.loaded().scenario().path.string(), 0}},
                     "this scenario has no checks, so there are no margins to be minimised",
                     "demand something of it in <stride:Checks>");
  }
  std::vector<std::string> names;
  for (const checks::Definition& check : checks) names.push_back(check.name);
  if (name.empty() || std::ranges::find(names, name) != names.end()) return;
  core::fail_input({}, fmt::format("--check: no check is called '{}'", name),
                   core::suggestion(name, names));
}

void add_campaign_search(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "search", "Look for the case that fails, led by the margins of the scenario's checks");
  const auto arguments = std::make_shared<SearchArguments>();
  add_search_options(*command, *arguments);
  command->callback([arguments] { search_campaign(*arguments); });
}

}  // namespace stride::cli
