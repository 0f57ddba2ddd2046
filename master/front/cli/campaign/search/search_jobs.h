// A search whose cases run on a cluster.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_JOBS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_JOBS_H

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/cases/case_jobs.h"
#include "master/front/cli/campaign/search/listed_cases.h"
#include "master/front/cli/campaign/search/search_options.h"

namespace stride::cli {

/// Submits what is missing of each generation as an array of jobs, and waits until it is there.
/// What became of a case is in its record; the cluster is only asked whether jobs are in its queue.
class SearchJobs {
 public:
  /// The arguments must outlive it. `on_wait` gets what is waited for, now and then.
  SearchJobs(const SearchArguments& arguments, const CampaignInput& input,
             std::function<void(const std::string& what)> on_wait);

  /// A RunBatch. Jobs that an earlier search in this folder has left in the queue are waited for
  /// before any are submitted. False if it was interrupted, which leaves the jobs in the queue, or
  /// if jobs have ended without records of all cases: these are not submitted again.
  bool run(const campaign::Plan& plan, const campaign::CaseFolder& cases,
           const campaign::CaseRange& batch);

  /// The script of the jobs for what is missing.
  std::string script(const campaign::CaseFolder& cases, const campaign::CaseRange& batch) const;

  /// Throws core::Error (Run) if jobs have ended so, with their log files.
  void require_records() const;
  /// What is in the queue after an interruption: "job 4711 of Slurm"; empty: nothing.
  const std::string& left() const { return left_; }
  const std::filesystem::path& folder() const { return jobs_.folder(); }

 private:
  struct Lost {
    std::vector<std::string> cases;
    std::vector<std::filesystem::path> logs;
  };

  JobArray array(const campaign::CaseFolder& cases, const campaign::CaseRange& batch) const;
  std::string text_of(const std::vector<std::string>& ids) const;
  bool wait(const std::vector<std::string>& ids, const campaign::CaseFolder& cases,
            const campaign::CaseRange& batch);
  bool are_in_queue(const std::vector<std::string>& ids);
  void note_lost(const std::string& id, const JobArray& array, const campaign::CaseFolder& cases,
                 const campaign::CaseRange& batch);

  const CaseJobs jobs_;
  const std::function<void(const std::string& what)> on_wait_;
  bool has_looked_for_earlier_ = false;
  int failed_questions_ = 0;  ///< to the cluster, one after the other
  std::string left_;
  Lost lost_;
};

}  // namespace stride::cli

#endif
