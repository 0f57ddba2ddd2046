// Texts that Slurm reads.
#ifndef STRIDE_MASTER_CLI_CLUSTER_SLURM_SCRIPT_H
#define STRIDE_MASTER_CLI_CLUSTER_SLURM_SCRIPT_H

#include <optional>
#include <string>

#include "master/cli/cluster/cluster.h"

namespace stride::cli {

/// A script for sbatch that needs no file beside it. Throws core::Error (Input) for an option that
/// is the script's own or has no name, and for a line end in what is one line there.
std::string slurm_script(const JobArray& array);

/// A limit of time [s]: "minutes", "minutes:seconds", "hours:minutes:seconds", "days-hours",
/// "days-hours:minutes", "days-hours:minutes:seconds"; infinity for "unlimited" and "infinite".
/// Nothing for what is none.
std::optional<double> slurm_seconds(const std::string& time);

}  // namespace stride::cli

#endif
