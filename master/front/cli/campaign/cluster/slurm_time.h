// Limits of time, as Slurm writes them.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_TIME_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_SLURM_TIME_H

#include <optional>
#include <string>

namespace stride::cli {

/// In seconds: "minutes", "minutes:seconds", "hours:minutes:seconds", "days-hours",
/// "days-hours:minutes", "days-hours:minutes:seconds"; infinity for "unlimited" and "infinite".
/// Nothing for what is none.
std::optional<double> slurm_seconds(const std::string& time);

}  // namespace stride::cli

#endif
