// Cases of a campaign, or of a search, as jobs of a cluster.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_JOBS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_JOBS_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/front/cli/campaign/cluster/cluster.h"
#include "master/study/campaign/cases/chunks.h"
#include "master/study/campaign/definition/definition.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stride::cli {

struct ClusterArguments {
  std::string cluster;                 ///< its word; empty: none
  JobRequest request;                  ///< without its processors
  std::optional<std::uint64_t> chunk;  ///< cases of a job
};

/// --on and --chunk, whose default `chunk` describes, and the options of a submission, which need
/// --on. `arguments` must outlive the command line. Returns --on.
CLI::Option* add_cluster_options(CLI::App& command, ClusterArguments& arguments,
                                 const std::string& chunk);

class CaseJobs {
 public:
  /// `folder`: that of the cases. `command`: of a job, behind
  /// the program; a range of cases follows it. `processors`:
  /// of a job, which runs as many cases at the same time. The other arguments must outlive it.
  CaseJobs(const ClusterArguments& arguments, const campaign::Campaign& campaign,
           const std::filesystem::path& folder, std::vector<std::string> command,
           std::uint64_t processors);

  const Cluster& cluster() const { return *cluster_; }
  /// Of scripts and log files, below that of the cases.
  const std::filesystem::path& folder() const { return folder_; }
  /// "4711.sh" in it.
  static std::string script_name(const std::string& id);
  /// Of a job of an array.
  std::filesystem::path log_file(const std::string& id, std::size_t job) const;

  /// How many of the missing cases a job runs. `job_time`: what jobs are to take, if they have more
  /// than one case at a time [s]. Throws core::Error (Input) for jobs that are too short for a
  /// case, and for more jobs than the cluster takes.
  std::uint64_t length(const campaign::CaseSurvey& survey,
                       double job_time = campaign::kJobTime) const;
  /// Jobs of this length for what is missing.
  JobArray array(const campaign::CaseSurvey& survey, std::uint64_t length) const;

  /// The arrays that were submitted with a script of this folder, and have not ended.
  std::vector<std::string> in_queue() const;
  /// Keeps the script by the name that the cluster gives to the array, and calls `is_submitted`
  /// with that. If it `waits`, it returns when the jobs have ended.
  void submit(const JobArray& array, bool waits,
              const std::function<void(const std::string& id)>& is_submitted) const;

 private:
  const ClusterArguments& arguments_;
  const campaign::Campaign& campaign_;
  const std::unique_ptr<const Cluster> cluster_;
  const std::filesystem::path folder_;
  const std::vector<std::string> command_;
  const std::uint64_t processors_;
};

}  // namespace stride::cli

#endif
