// What a campaign wants of a cluster, whichever workload manager that has.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CLUSTER_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CLUSTER_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "master/study/campaign/cases/case_range.h"

namespace stride::cli {

/// What is asked of the workload manager for each job, in its own words; empty: its defaults.
struct JobRequest {
  std::string partition;
  std::string time;  ///< limit of a job
  std::string licenses;
  std::string account;
  std::vector<std::string> further;  ///< options of the submission, "mem=4G"
  std::uint64_t processors = 1;
};

/// Jobs that run the same command, each with a range of cases as its last word.
struct JobArray {
  std::string name;
  std::string comment;                   ///< a line of the script
  std::filesystem::path working_folder;  ///< absolute
  std::filesystem::path log_folder;      ///< absolute
  std::vector<std::string> environment;  ///< "NAME=VALUE"
  std::vector<std::string> command;
  std::vector<campaign::CaseRange> ranges;
  JobRequest request;
};

/// A workload manager: it takes job arrays. Nothing about the cases is asked of it. Each function
/// throws core::Error (Input) where the programs of the workload manager are not there, and
/// core::Error (Run) with what they have printed where they fail.
class Cluster {
 public:
  virtual ~Cluster() = default;

  /// "slurm": on the command line, and of the folder of scripts and log files.
  virtual std::string word() const = 0;
  /// "Slurm"
  virtual std::string name() const = 0;

  /// A limit of time, as the user writes it, in seconds; infinity for none. Throws core::Error
  /// (Input).
  virtual double seconds(const std::string& time) const = 0;
  /// The most jobs that an array may have.
  virtual std::uint64_t most_jobs() const = 0;
  /// The arrays of the user that have not ended, by the words that submit() gives them.
  virtual std::vector<std::string> arrays_in_queue() const = 0;

  /// A script that can also be submitted by hand. Throws core::Error (Input) for a request that
  /// cannot be written.
  virtual std::string script(const JobArray& array) const = 0;
  /// Submits a script in the working folder of its array, and calls `is_submitted` with the word
  /// for the array. If it `waits`, it returns when the jobs have ended, however that was.
  virtual void submit(const std::filesystem::path& script, bool waits,
                      const std::function<void(const std::string& id)>& is_submitted) const = 0;
};

}  // namespace stride::cli

#endif
