// Slurm, by its own commands: sbatch, scontrol and squeue.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_H

#include "master/front/cli/campaign/cluster/cluster.h"

namespace stride::cli {

class Slurm final : public Cluster {
 public:
  std::string word() const override { return "slurm"; }
  std::string name() const override { return "Slurm"; }
  double seconds(const std::string& time) const override;
  std::uint64_t most_jobs() const override;
  std::vector<std::string> arrays_in_queue() const override;
  std::string script(const JobArray& array) const override;
  void submit(const std::filesystem::path& script, bool waits,
              const std::function<void(const std::string& id)>& is_submitted) const override;
};

}  // namespace stride::cli

#endif
