// The script of an array of jobs of Slurm.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_SCRIPT_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_SCRIPT_H

#include <string>

#include "master/front/cli/campaign/cluster/cluster.h"

namespace stride::cli {

/// A script for sbatch that needs no file beside it. Throws core::Error (Input) for an option that
/// is the script's own or has no name, and for a line end in what is one line there.
std::string slurm_script(const JobArray& array);

}  // namespace stride::cli

#endif
