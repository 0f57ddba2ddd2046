// The workload managers that there are.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CLUSTERS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CLUSTERS_H

#include <memory>
#include <string>
#include <vector>

#include "master/front/cli/campaign/cluster/cluster.h"

namespace stride::cli {

/// Their words on the command line.
std::vector<std::string> cluster_words();
/// `word` is one of them.
std::unique_ptr<Cluster> make_cluster(const std::string& word);

}  // namespace stride::cli

#endif
