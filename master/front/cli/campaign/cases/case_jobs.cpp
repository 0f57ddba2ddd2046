#include "master/front/cli/campaign/cases/case_jobs.h"

#include <cstdlib>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/front/cli/campaign/cluster/clusters.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/plan.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScriptEnd = ".sh";

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

std::uint64_t length_of(std::optional<std::uint64_t> chunk, const campaign::CaseSurvey& survey,
                        const campaign::ChunkNeeds& needs) {
  if (!chunk) return campaign::chunk_length(survey.missing, needs);
  const std::uint64_t count = campaign::chunk_count(survey.missing, *chunk);
  if (count <= needs.most_chunks) return *chunk;
  core::fail_input(
      {},
      fmt::format("--chunk {}: that makes {} jobs, and an array may have {}", *chunk, count,
                  needs.most_chunks),
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

std::vector<std::string> with_program(std::vector<std::string> words) {
  words.insert(words.begin(), fs::read_symlink("/proc/self/exe").string());
  return words;
}

}  // namespace

CLI::Option* add_cluster_options(CLI::App& command, ClusterArguments& arguments,
                                 const std::string& chunk) {
  const std::vector<std::string> clusters = cluster_words();
  CLI::Option* const on =
      command.add_option("--on", arguments.cluster, "The workload manager of the cluster")
          ->type_name(fmt::format("{}", fmt::join(clusters, "|")))
          ->check(CLI::IsMember(clusters).description(""));
  const auto add = [&](const char* name, auto& value, const std::string& text, const char* type) {
    return command.add_option(name, value, text)->type_name(type)->needs(on);
  };
  JobRequest& request = arguments.request;
  add("--chunk", arguments.chunk, "How many cases a job runs; otherwise " + chunk, "N")
      ->check(CLI::Range(std::uint64_t{1}, campaign::Plan::kMostCases));
  add("--partition", request.partition, "Partition of the cluster, as sbatch has it", "NAME");
  add("--time", request.time,
      "Limit of time of a job, as sbatch has it: minutes, hours:minutes:seconds, days-hours …",
      "TIME");
  add("--licenses", request.licenses, "Licenses of a job, as sbatch has it", "NAME:COUNT");
  add("--account", request.account, "Account of the jobs, as sbatch has it", "NAME");
  add("--sbatch", request.further,
      "Any other option of sbatch, such as mem=4G; may be given several times", "OPTION");
  return on;
}

CaseJobs::CaseJobs(const ClusterArguments& arguments, const campaign::Campaign& campaign,
                   const fs::path& folder, std::vector<std::string> command,
                   std::uint64_t processors)
    : arguments_(arguments),
      campaign_(campaign),
      cluster_(make_cluster(arguments.cluster)),
      folder_(folder / cluster_->word()),
      command_(with_program(std::move(command))),
      processors_(processors) {}

std::string CaseJobs::script_name(const std::string& id) { return id + kScriptEnd; }

fs::path CaseJobs::log_file(const std::string& id, std::size_t job) const {
  return folder_ / fmt::format("{}_{}.log", id, job);
}

std::uint64_t CaseJobs::length(const campaign::CaseSurvey& survey, double job_time) const {
  const std::string& time = arguments_.request.time;
  campaign::ChunkNeeds needs{
      .wall_time = survey.wall_time, .job_time = job_time, .side_by_side = processors_};
  if (!time.empty()) {
    needs.time_limit = cluster_->seconds(time);
    refuse_short_jobs(time, *needs.time_limit, campaign_, survey.wall_time);
  }
  needs.most_chunks = cluster_->most_jobs();
  return length_of(arguments_.chunk, survey, needs);
}

JobArray CaseJobs::array(const campaign::CaseSurvey& survey, std::uint64_t length) const {
  JobRequest request = arguments_.request;
  request.processors = processors_;
  return {
      .name = campaign_.file.stem().string(),
      .comment = fmt::format("Cases of {}, by stride {}. Each job of the array runs those of its "
                             "range that have no record.",
                             campaign_.file.filename().string(), STRIDE_VERSION),
      .working_folder = fs::current_path(),
      .log_folder = fs::absolute(folder_),
      .environment = environment(),
      .command = command_,
      .ranges = campaign::chunks(survey.is_missing, length),
      .request = std::move(request)};
}

std::vector<std::string> CaseJobs::in_queue() const {
  std::vector<std::string> ours = cluster_->arrays_in_queue();
  std::erase_if(ours,
                [&](const std::string& id) { return !core::is_file(folder_ / script_name(id)); });
  return ours;
}

void CaseJobs::submit(const JobArray& array, bool waits,
                      const std::function<void(const std::string& id)>& is_submitted) const {
  const std::string script = cluster_->script(array);
  recorders::make_results_folder(folder_);
  const fs::path fresh = folder_ / script_name("submitted");
  core::Replacement replacement(fresh);
  replacement.file().write(script);
  replacement.commit();
  cluster_->submit(fs::absolute(fresh), waits, [&](const std::string& id) {
    fs::rename(fresh, folder_ / script_name(id));
    is_submitted(id);
  });
}

}  // namespace stride::cli
