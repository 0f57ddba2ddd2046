#include "master/cli/cluster/clusters.h"

#include "master/cli/cluster/slurm.h"

namespace stride::cli {

std::vector<std::string> cluster_words() { return {Slurm().word()}; }

std::unique_ptr<Cluster> make_cluster(const std::string& /*word*/) {
  return std::make_unique<Slurm>();
}

}  // namespace stride::cli
