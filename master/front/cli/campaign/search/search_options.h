// What stride campaign search is asked for.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_OPTIONS_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_OPTIONS_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/cases/case_jobs.h"
#include "master/front/cli/terminal/progress.h"
#include "master/study/campaign/cases/case_range.h"
#include "master/study/search/search.h"

namespace stride::cli {

struct SearchArguments {
  CampaignArguments campaign;
  search::Request request;
  std::size_t jobs = 0;      ///< 0: not given
  ClusterArguments cluster;  ///< which runs the cases, if one is named
  bool is_dry = false;       ///< print the script of the jobs of the present generation
  std::optional<campaign::CaseRange> range;  ///< of the present generation: run these
  bool lists_next = false;                   ///< print what is missing of that
  std::optional<ProgressStyle> progress;
  bool quiet = false;
};

/// `arguments` must outlive the command line.
void add_search_options(CLI::App& command, SearchArguments& arguments);

/// How many cases of a job of a cluster run at the same time.
std::size_t cases_side_by_side(const SearchArguments& arguments);
/// The words behind the program of what runs some cases of the search in this folder: a range of
/// them follows.
std::vector<std::string> part_words(const SearchArguments& arguments,
                                    const std::filesystem::path& folder);

}  // namespace stride::cli

#endif
