#include "master/front/cli/campaign/campaign_submit.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/front/cli/campaign/campaign_run.h"
#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/cases/case_jobs.h"
#include "master/front/cli/campaign/cases/case_options.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/chunks.h"
#include "master/study/campaign/plan_check.h"
#include "master/study/campaign/plan_folder.h"

namespace stride::cli {
namespace {

struct SubmitArguments {
  CampaignArguments campaign;
  ClusterArguments cluster;
  std::uint64_t processors = 1;  ///< of a job
  bool is_dry = false;
  bool waits = false;
};

/// The command of a job.
std::vector<std::string> job_words(const SubmitArguments& arguments) {
  const CampaignArguments& named = arguments.campaign;
  std::vector<std::string> words{"campaign", "run", named.file.string()};
  if (!named.out.empty()) words.insert(words.end(), {"--out", named.out.string()});
  words.insert(words.end(), {"--jobs", std::to_string(arguments.processors), "--cases"});
  return words;
}

/// Cases that are in the queue already would run twice.
void refuse_queued(const CaseJobs& jobs) {
  const std::vector<std::string> ours = jobs.in_queue();
  if (ours.empty()) return;
  core::fail_input({.where = {jobs.folder().string(), 0}},
                   fmt::format("cases of this campaign are in the queue of {} still, as job {}",
                               jobs.cluster().name(), core::abridged(ours, 5)),
                   "wait for their end, or cancel them first");
}

class Submission {
 public:
  Submission(const SubmitArguments& arguments, const CampaignInput& input)
      : arguments_(arguments),
        input_(input),
        jobs_(arguments.cluster, input.plan().campaign(), input.folder(), job_words(arguments),
              arguments.processors),
        survey_(campaign::survey({input.plan(), input.folder()}, input.plan().size())) {}

  void run() const {
    const campaign::Plan& plan = input_.plan();
    const bool has_plan = campaign::has_plan(plan, input_.folder());
    if (!has_plan && arguments_.is_dry) campaign::check_plan(plan, input_.scenario());
    if (survey_.missing == 0) {
      print_text("{}: {} of {} done, nothing is submitted\n", name(), plan.size(),
                 core::counted(plan.size(), "case"));
      if (arguments_.waits) require_all_there();
      return;
    }
    const std::uint64_t length = jobs_.length(survey_);
    const JobArray array = jobs_.array(survey_, length);
    const std::string script = jobs_.cluster().script(array);
    if (arguments_.is_dry) return print_text("{}", script);
    input_.make_plan();
    recorders::make_results_folder(jobs_.folder());
    const recorders::ResultsLock lock(jobs_.folder());
    refuse_queued(jobs_);
    jobs_.submit(array, arguments_.waits,
                 [&](const std::string& id) { print_submitted(id, array.ranges.size(), length); });
    if (arguments_.waits) require_all_there();
  }

 private:
  std::string name() const { return input_.plan().campaign().file.stem().string(); }

  void print_submitted(const std::string& id, std::size_t jobs, std::uint64_t length) const {
    print_text("{}: {} of {} missing, submitted to {} as job {}: {} with up to {}\n", name(),
               survey_.missing, core::counted(input_.plan().size(), "case"), jobs_.cluster().name(),
               id, jobs == 1 ? "one job" : fmt::format("an array of {} jobs", jobs),
               std::min(length, survey_.missing));
    print_text("\nScript and log files in {}: {} {}_*.log\n", jobs_.folder().string(),
               CaseJobs::script_name(id), id);
    if (!arguments_.waits) {
      print_text("Progress and table: stride campaign status {}\n", input_.word());
    }
    std::fflush(stdout);
  }

  void require_all_there() const {
    print_text("\n");
    const campaign::CaseSummary summary = print_status(input_);
    const campaign::CaseTotals& totals = summary.totals;
    if (totals.missing() > 0) {
      core::fail_run({},
                     fmt::format("the jobs have left the queue of {}, and {} of {} cases have no "
                                 "record",
                                 jobs_.cluster().name(), totals.missing(), totals.cases),
                     fmt::format("see the log files in {}; submitting the campaign again submits "
                                 "these cases",
                                 jobs_.folder().string()));
    }
    require_all_passed(input_, totals);
    require_goals(input_, summary);
  }

  const SubmitArguments& arguments_;
  const CampaignInput& input_;
  const CaseJobs jobs_;
  const campaign::CaseSurvey survey_;
};

void submit_campaign(const SubmitArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign);
  input.refuse_inputs({campaign::kPlanTable, campaign::kPlanDescription, campaign::kCases,
                       campaign::kRunning, arguments.cluster.cluster.c_str()});
  Submission(arguments, input).run();
}

}  // namespace

void add_campaign_submit(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "submit", "Run the cases that have no record yet on a cluster, as an array of jobs");
  const auto arguments = std::make_shared<SubmitArguments>();
  add_campaign_options(*command, arguments->campaign);
  add_cluster_options(*command, arguments->cluster,
                      "as many as take some minutes, or, where no case is done yet, a hundredth of "
                      "them")
      ->required();
  command
      ->add_option("--jobs", arguments->processors,
                   "How many cases of a job run at the same time; it gets as many processors")
      ->type_name("N")
      ->check(CLI::Range(1, kMostCaseJobs));
  command->add_flag("--wait", arguments->waits,
                    "Wait until the jobs have left the queue, and make the table");
  command->add_flag("--dry-run", arguments->is_dry,
                    "Print the script of the jobs; submit and write nothing");
  command->callback([arguments] { submit_campaign(*arguments); });
}

}  // namespace stride::cli
