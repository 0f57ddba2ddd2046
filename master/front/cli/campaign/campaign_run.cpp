#include "master/front/cli/campaign/campaign_run.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/message_text.h"
#include "master/base/text/counted.h"
#include "master/base/text/shell_word.h"
#include "master/front/cli/campaign/campaign_report.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/cases/case_options.h"
#include "master/front/cli/campaign/cases/case_pool.h"
#include "master/front/cli/campaign/cases/case_runner.h"
#include "master/front/cli/campaign/cases/missing_cases.h"
#include "master/front/cli/coverage/coverage_table.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/coverage/demand.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_range.h"
#include "master/study/campaign/evaluation/campaign_junit.h"
#include "master/study/campaign/evaluation/campaign_page.h"
#include "master/study/campaign/evaluation/case_table.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/results/output_paths.h"
#include "master/study/results/report_page.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShownFailures = 10;

struct CampaignRunArguments {
  CampaignArguments campaign;
  std::size_t jobs = 0;                      ///< 0: as many as there are cores
  std::optional<std::uint64_t> only;         ///< the case to be run
  std::optional<campaign::CaseRange> range;  ///< the cases to be run; nothing: all
  fs::path junit;                            ///< empty: none
  std::optional<ProgressStyle> progress;
  bool quiet = false;
};

std::string cases_text(std::uint64_t count) { return core::counted(count, "case"); }

void print_failures(const campaign::Plan& plan, const campaign::CaseSummary& summary) {
  if (summary.first_failures.empty()) return;
  Table table({{"case", Table::Align::Right}, {"outcome"}, {"because", Table::Align::Left, true}});
  for (const auto& [index, result] : summary.first_failures) {
    table.add({std::to_string(index), name(result.outcome), core::first_line(result.reason)});
  }
  const bool are_all = summary.totals.failed == summary.first_failures.size();
  print_text("\n{} failures\n{}\nEach is repeated by\n", are_all ? "All" : "First",
             table.text(output_width()));
  for (const campaign::FailedCase& failed : summary.first_failures) {
    print_text("  {}: {}\n", failed.index, plan.command(plan.at(failed.index)));
  }
}

std::string group_text(const coverage::GroupReport& group, const char* goal) {
  std::string text =
      fmt::format("'{}' is {}", group.component, coverage::percentage_text(group.percentage()));
  if (group.goal) text += fmt::format("{} {} %", goal, *group.goal);
  return text;
}

void print_coverage(const campaign::CaseSummary& summary) {
  if (!summary.coverage) return;
  print_text("\n");
  for (const coverage::GroupReport& group : summary.coverage->groups) {
    print_text("Coverage of {}\n", group_text(group, "; the goal is"));
  }
  print_text("{}", told_apart_table(*summary.coverage));
  if (summary.without_bins == 0) return;
  print_text("{} not counted in it, since nothing says any more which bins they had\n",
             cases_text(summary.without_bins));
}

void print_summary(const CampaignInput& input, const campaign::CaseSummary& summary) {
  const campaign::CaseTotals& totals = summary.totals;
  print_text("{}: {} of {} done, {} passed, {} failed, {} missing\n",
             input.plan().campaign().file.stem().string(), totals.done(), cases_text(totals.cases),
             totals.passed, totals.failed, totals.missing());
  print_failures(input.plan(), summary);
  print_coverage(summary);
  print_text("\nTable in {}: {} {}{}\n", input.folder().string(), campaign::kCaseTable,
             campaign::kCaseLines,
             summary.coverage ? fmt::format(" {}", coverage::kCoverageFile) : "");
}

}  // namespace

void require_all_passed(const CampaignInput& input, const campaign::CaseTotals& totals) {
  if (MissingCases::is_interrupted() || totals.missing() > 0) {
    core::fail_run(
        {},
        fmt::format("the campaign {}; {} of {} are done",
                    MissingCases::is_interrupted() ? "was interrupted" : "is not complete",
                    totals.done(), cases_text(totals.cases)),
        fmt::format("it goes on with: stride campaign run {}", input.word()));
  }
  if (totals.failed == 0) return;
  if (totals.cases == 1) core::fail_run({}, "the only case has not passed");
  core::fail_run({}, fmt::format("{} of {} {} not passed", totals.failed, cases_text(totals.cases),
                                 totals.failed == 1 ? "has" : "have"));
}

void require_goals(const CampaignInput& input, const campaign::CaseSummary& summary) {
  if (!summary.coverage) return;
  std::vector<std::string> missed;
  for (const coverage::GroupReport& group : summary.coverage->groups) {
    if (group.misses_goal()) missed.push_back(group_text(group, ", below the goal of"));
  }
  if (missed.empty()) return;
  core::fail_run(
      {},
      fmt::format("the campaign is complete, and its coverage of {}", fmt::join(missed, "; of ")),
      fmt::format("'stride coverage {} --missing' lists what is missing",
                  core::shell_word(input.folder().string())));
}

namespace {

MissingCases::Options missing_options(const CampaignRunArguments& arguments,
                                      const CampaignInput& input) {
  return {.range = arguments.range.value_or(campaign::CaseRange{0, input.plan().size() - 1}),
          .jobs = jobs_or_cores(arguments.jobs),
          .progress = chosen_style(arguments.progress, arguments.quiet)};
}

/// A page that cannot be written does not hide what became of the cases.
void write_page(const CampaignRunArguments& arguments, const CampaignInput& input,
                const campaign::CaseFolder& cases) {
  if (!results::has_reports()) return;
  const fs::path page = input.folder() / campaign::kCampaignPage;
  write_campaign_report(page, input, cases);
  if (!arguments.quiet) print_text("Page in {}\n", page.string());
}

void run_missing(const CampaignRunArguments& arguments, const CampaignInput& input) {
  const recorders::ResultsLock lock(input.folder());
  const campaign::CaseFolder cases(input.plan(), input.folder());
  const campaign::CaseScratch scratch(cases);
  const Interruption interruption;
  MissingCases(input.plan(), input.scenario(), cases, scratch, missing_options(arguments, input))
      .run();
  const campaign::CaseSummary summary =
      write_case_tables(input.plan(), cases, scratch, kShownFailures, input.case_definitions());
  if (!arguments.junit.empty()) {
    write_campaign_junit(arguments.junit, input.plan(), cases, summary.totals);
  }
  if (!arguments.quiet) print_summary(input, summary);
  warn_of_failure([&] { write_page(arguments, input, cases); });
  require_all_passed(input, summary.totals);
  require_goals(input, summary);
}

/// Others may be at work in the folder, so it is not locked, and the table is not made.
void run_range(const CampaignRunArguments& arguments, const CampaignInput& input) {
  const campaign::CaseFolder cases(input.plan(), input.folder());
  const campaign::CaseScratch scratch(cases);
  const Interruption interruption;
  MissingCases missing(input.plan(), input.scenario(), cases, scratch,
                       missing_options(arguments, input));
  missing.run();
  const campaign::CaseTotals& totals = missing.totals();
  if (!arguments.quiet) {
    print_text("cases {}: {} passed, {} failed, {} missing\n", to_text(*arguments.range),
               totals.passed, totals.failed, totals.missing());
  }
  require_all_passed(input, totals);
}

std::optional<campaign::CaseResult> run_case(const CampaignInput& input,
                                             const campaign::CaseFolder& cases,
                                             std::uint64_t index) {
  const campaign::CaseScratch scratch(cases);
  const Interruption interruption;
  const CaseRunner runner(input.plan(), input.scenario(), scratch);
  CasePool pool(1, case_options(input.plan().campaign()));
  pool.adopt_orphans();
  const auto work = [&] { return runner.run(index); };
  CasePool::Ended ended = pool.run_alone(index, work);
  if (runner.is_doubtful(ended)) ended = pool.run_alone(index, work);
  return runner.conclude(ended);
}

void run_only(const CampaignRunArguments& arguments, const CampaignInput& input) {
  const std::uint64_t index = *arguments.only;
  const campaign::CaseFolder cases(input.plan(), input.folder());
  const auto record = cases.read(index);
  const auto result = record ? record->result : run_case(input, cases, index);
  if (!result) core::fail_run({}, fmt::format("case {} was interrupted", index));
  if (result->outcome != campaign::Outcome::Passed) {
    core::fail_run({},
                   fmt::format("case {}: {}: {}", index, name(result->outcome), result->reason));
  }
  if (!arguments.quiet) print_text("case {}: {}\n", index, name(result->outcome));
}

void run_campaign(const CampaignRunArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign);
  if (arguments.only) input.require_case(*arguments.only, "--case");
  if (arguments.range) input.require_case(arguments.range->last, "--cases");
  using namespace campaign;
  input.refuse_inputs({kPlanTable, kPlanDescription, kDescriptions, kCaseTable, kCaseLines,
                       kCampaignPage, coverage::kCoverageFile, kCases, kRunning});
  if (!arguments.junit.empty()) {
    input.refuse_output({"--junit " + arguments.junit.string(), arguments.junit});
  }
  input.make_plan();
  if (arguments.only) return run_only(arguments, input);
  if (arguments.range) return run_range(arguments, input);
  run_missing(arguments, input);
}

}  // namespace

campaign::CaseSummary print_status(const CampaignInput& input) {
  input.require_plan();
  input.refuse_inputs(
      {campaign::kCaseTable, campaign::kCaseLines, coverage::kCoverageFile, campaign::kRunning});
  const campaign::CaseFolder cases(input.plan(), input.folder());
  const campaign::CaseScratch scratch(cases);
  const campaign::CaseSummary summary =
      write_case_tables(input.plan(), cases, scratch, kShownFailures, input.case_definitions());
  print_summary(input, summary);
  return summary;
}

void add_campaign_run(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "run", "Run the cases that have no record yet; the plan is made where there is none");
  const auto arguments = std::make_shared<CampaignRunArguments>();
  add_campaign_options(*command, arguments->campaign);
  CLI::Option* jobs = add_jobs_option(*command, arguments->jobs);
  CLI::Option* only =
      add_case_option(*command, arguments->only,
                      "Run this case only, counted from 0, and make no table: for other runners, "
                      "which may run several at the same time")
          ->excludes(jobs);
  CLI::Option* range =
      add_cases_option(*command, arguments->range,
                       "Run those of these cases that have no record, counted from 0, and make no "
                       "table: likewise, for many short cases")
          ->excludes(only);
  command
      ->add_option("--junit", arguments->junit,
                   "Write a test report in the XML of JUnit, with a test case for each case")
      ->type_name("FILE")
      ->excludes(only)
      ->excludes(range);
  add_progress_options(*command, arguments->progress, arguments->quiet);
  command->callback([arguments] { run_campaign(*arguments); });
}

void add_campaign_status(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "status", "Say how many cases are done, and make the table of what is known");
  const auto arguments = std::make_shared<CampaignArguments>();
  add_campaign_options(*command, *arguments);
  command->callback([arguments] {
    const CrashGuard guard;
    print_status(CampaignInput(*arguments, Purpose::Read));
  });
}

}  // namespace stride::cli
