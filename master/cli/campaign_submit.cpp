#include "master/cli/campaign_submit.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/campaign/case_folder.h"
#include "master/campaign/chunks.h"
#include "master/campaign/plan_check.h"
#include "master/campaign/plan_folder.h"
#include "master/cli/campaign_input.h"
#include "master/cli/campaign_run.h"
#include "master/cli/case_options.h"
#include "master/cli/cluster/clusters.h"
#include "master/cli/crash_guard.h"
#include "master/cli/output.h"
#include "master/recorders/results_folder.h"
#include "master/util/error.h"
#include "master/util/input_file.h"
#include "master/util/replacement.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScriptEnd = ".sh";

struct SubmitArguments {
  CampaignArguments campaign;
  std::string cluster;
  JobRequest request;
  std::optional<std::uint64_t> chunk;  ///< cases of a job
  bool is_dry = false;
  bool waits = false;
};

/// With its unit, which limits of time have in common.
std::string seconds_text(double seconds) { return fmt::format("{:.6g} s", seconds); }

/// A job that is shorter than a case would never come to its end, however often it is submitted.
void refuse_short_jobs(const std::string& time, double limit, const campaign::Campaign& campaign,
                       std::optional<double> wall_time) {
  const auto refuse = [&](double needed, const char* why) {
    core::fail_input({},
                     fmt::format("--time {} is {}, and {} {}", time, seconds_text(limit), why,
                                 seconds_text(needed)),
                     "give the jobs more time");
  };
  const std::optional<double> longest = campaign.wall_time_limit;
  if (longest && *longest >= limit) refuse(*longest, "by its Limit wallTime a case may take");
  if (wall_time && *wall_time >= limit) refuse(*wall_time, "on average a case takes");
}

std::uint64_t length_of(const SubmitArguments& arguments, const campaign::CaseSurvey& survey,
                        const campaign::ChunkNeeds& needs) {
  if (!arguments.chunk) return campaign::chunk_length(survey.missing, needs);
  const std::uint64_t count = campaign::chunk_count(survey.missing, *arguments.chunk);
  if (count <= needs.most_chunks) return *arguments.chunk;
  core::fail_input(
      {},
      fmt::format("--chunk {}: that makes {} jobs, and an array may have {}", *arguments.chunk,
                  count, needs.most_chunks),
      fmt::format("--chunk {} or more", campaign::chunk_count(survey.missing, needs.most_chunks)));
}

/// What decides which files a run finds, and is no part of its command.
std::vector<std::string> environment() {
  std::vector<std::string> variables;
  for (const char* name : {"STRIDE_UNITS", "LD_LIBRARY_PATH"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr) variables.push_back(fmt::format("{}={}", name, value));
  }
  return variables;
}

JobArray array_of(const SubmitArguments& arguments, const campaign::Campaign& campaign,
                  const fs::path& log_folder, std::vector<campaign::CaseRange> ranges) {
  const CampaignArguments& named = arguments.campaign;
  std::vector<std::string> command{fs::read_symlink("/proc/self/exe").string(), "campaign", "run",
                                   named.file.string()};
  if (!named.out.empty()) command.insert(command.end(), {"--out", named.out.string()});
  command.insert(command.end(),
                 {"--jobs", std::to_string(arguments.request.processors), "--cases"});
  return {
      .name = campaign.file.stem().string(),
      .comment = fmt::format("Cases of {}, by stride {}. Each job of the array runs those of its "
                             "range that have no record.",
                             campaign.file.filename().string(), STRIDE_VERSION),
      .working_folder = fs::current_path(),
      .log_folder = fs::absolute(log_folder),
      .environment = environment(),
      .command = std::move(command),
      .ranges = std::move(ranges),
      .request = arguments.request};
}

/// Cases that are in the queue already would run twice.
void refuse_queued(const Cluster& cluster, const fs::path& folder) {
  const std::vector<std::string> queued = cluster.arrays_in_queue();
  std::vector<std::string> ours;
  for (const std::string& id : queued) {
    if (core::is_file(folder / (id + kScriptEnd))) ours.push_back(id);
  }
  if (ours.empty()) return;
  core::fail_input({.where = {folder.string(), 0}},
                   fmt::format("cases of this campaign are in the queue of {} still, as job {}",
                               cluster.name(), core::abridged(ours, 5)),
                   "wait for their end, or cancel them first");
}

class Submission {
 public:
  Submission(const SubmitArguments& arguments, const CampaignInput& input)
      : arguments_(arguments),
        input_(input),
        cluster_(make_cluster(arguments.cluster)),
        folder_(input.folder() / cluster_->word()),
        survey_(campaign::survey({input.plan(), input.folder()}, input.plan().size())) {}

  void run() const {
    const campaign::Plan& plan = input_.plan();
    const bool has_plan = campaign::has_plan(plan, input_.folder());
    if (!has_plan && arguments_.is_dry) campaign::check_plan(plan, input_.scenario());
    if (survey_.missing == 0) {
      print_text("{}: all of {} cases are done, and nothing is submitted\n", name(), plan.size());
      if (arguments_.waits) require_all_there();
      return;
    }
    const std::uint64_t length = chosen_length();
    const JobArray array = array_of(arguments_, plan.campaign(), folder_,
                                    campaign::chunks(survey_.is_missing, length));
    const std::string script = cluster_->script(array);
    if (arguments_.is_dry) return print_text("{}", script);
    input_.make_plan();
    recorders::make_results_folder(folder_);
    const recorders::ResultsLock lock(folder_);
    refuse_queued(*cluster_, folder_);
    submit(script, array.ranges.size(), length);
    if (arguments_.waits) require_all_there();
  }

 private:
  std::string name() const { return input_.plan().campaign().file.stem().string(); }

  std::uint64_t chosen_length() const {
    const std::string& time = arguments_.request.time;
    campaign::ChunkNeeds needs{.wall_time = survey_.wall_time,
                               .side_by_side = arguments_.request.processors};
    if (!time.empty()) {
      needs.time_limit = cluster_->seconds(time);
      refuse_short_jobs(time, *needs.time_limit, input_.plan().campaign(), survey_.wall_time);
    }
    needs.most_chunks = cluster_->most_jobs();
    return length_of(arguments_, survey_, needs);
  }

  /// The script is kept by the name that the cluster gives to the array.
  void submit(const std::string& script, std::size_t jobs, std::uint64_t length) const {
    const fs::path fresh = folder_ / (std::string("submitted") + kScriptEnd);
    core::Replacement replacement(fresh);
    replacement.file().write(script);
    replacement.commit();
    cluster_->submit(fs::absolute(fresh), arguments_.waits, [&](const std::string& id) {
      fs::rename(fresh, folder_ / (id + kScriptEnd));
      print_submitted(id, jobs, length);
    });
  }

  void print_submitted(const std::string& id, std::size_t jobs, std::uint64_t length) const {
    print_text("{}: {} of {} cases are missing, submitted to {} as job {}: {} with up to {}\n",
               name(), survey_.missing, input_.plan().size(), cluster_->name(), id,
               jobs == 1 ? "one job" : fmt::format("an array of {} jobs", jobs),
               std::min(length, survey_.missing));
    print_text("\nScript and log files in {}: {}{} {}_*.log\n", folder_.string(), id, kScriptEnd,
               id);
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
                                 cluster_->name(), totals.missing(), totals.cases),
                     fmt::format("see the log files in {}; submitting the campaign again submits "
                                 "these cases",
                                 folder_.string()));
    }
    require_all_passed(input_, totals);
    require_goals(input_, summary);
  }

  const SubmitArguments& arguments_;
  const CampaignInput& input_;
  const std::unique_ptr<const Cluster> cluster_;
  const fs::path folder_;  ///< of scripts and log files
  const campaign::CaseSurvey survey_;
};

void submit_campaign(const SubmitArguments& arguments) {
  const CrashGuard guard;
  const CampaignInput input(arguments.campaign);
  input.refuse_inputs({campaign::kPlanTable, campaign::kPlanDescription, campaign::kCases,
                       campaign::kRunning, arguments.cluster.c_str()});
  Submission(arguments, input).run();
}

void add_request_options(CLI::App& command, JobRequest& request) {
  command
      .add_option("--partition", request.partition, "Partition of the cluster, as sbatch has it")
      ->type_name("NAME");
  command
      .add_option("--time", request.time,
                  "Limit of time of a job, as sbatch has it: minutes, hours:minutes:seconds, "
                  "days-hours …")
      ->type_name("TIME");
  command.add_option("--licenses", request.licenses, "Licenses of a job, as sbatch has it")
      ->type_name("NAME:COUNT");
  command.add_option("--account", request.account, "Account of the jobs, as sbatch has it")
      ->type_name("NAME");
  command
      .add_option("--sbatch", request.further,
                  "Any other option of sbatch, such as mem=4G; may be given several times")
      ->type_name("OPTION");
}

}  // namespace

void add_campaign_submit(CLI::App& group) {
  CLI::App* command = group.add_subcommand(
      "submit", "Run the cases that have no record yet on a cluster, as an array of jobs");
  const auto arguments = std::make_shared<SubmitArguments>();
  add_campaign_options(*command, arguments->campaign);
  const std::vector<std::string> clusters = cluster_words();
  command->add_option("--on", arguments->cluster, "The workload manager of the cluster")
      ->required()
      ->type_name(fmt::format("{}", fmt::join(clusters, "|")))
      ->check(CLI::IsMember(clusters).description(""));
  command
      ->add_option(
          "--chunk", arguments->chunk,
          "How many cases a job runs; otherwise as many as take some minutes, or, where no "
          "case is done yet, a hundredth of them")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, campaign::Plan::kMostCases));
  command
      ->add_option("--jobs", arguments->request.processors,
                   "How many cases of a job run at the same time; it gets as many processors")
      ->type_name("N")
      ->check(CLI::Range(1, kMostCaseJobs));
  add_request_options(*command, arguments->request);
  command->add_flag("--wait", arguments->waits,
                    "Wait until the jobs have left the queue, and make the table");
  command->add_flag("--dry-run", arguments->is_dry,
                    "Print the script of the jobs; submit and write nothing");
  command->callback([arguments] { submit_campaign(*arguments); });
}

}  // namespace stride::cli
