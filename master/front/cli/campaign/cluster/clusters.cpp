#include "master/front/cli/campaign/cluster/clusters.h"

#include "master/front/cli/campaign/cluster/slurm.h"

namespace stride::cli {

std::vector<std::string> cluster_words() { return {Slurm().word()}; }

std::unique_ptr<Cluster> make_cluster(const std::string& /*word*/) {
  return std::make_unique<Slurm>();
}

}  // namespace stride::cli
