// Options of the commands that run cases of a campaign.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_OPTIONS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CASES_CASE_OPTIONS_H

#include <cstddef>
#include <optional>

#include "master/front/cli/terminal/progress.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stride::cli {

inline constexpr int kMostCaseJobs = 1024;

/// --jobs N. `jobs` must outlive the command line; it stays 0 where the option is not given.
CLI::Option* add_jobs_option(CLI::App& command, std::size_t& jobs);
/// The number that was given, or else of cores.
std::size_t jobs_or_cores(std::size_t jobs);

/// --progress and --quiet, likewise.
void add_progress_options(CLI::App& command, std::optional<ProgressStyle>& progress, bool& quiet);
/// The style that was given, or else what --quiet asks for.
ProgressStyle chosen_style(const std::optional<ProgressStyle>& progress, bool quiet);

}  // namespace stride::cli

#endif
