// Some cases of the present generation of a search: the first one that lacks records. For runners
// other than the search itself.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_PART_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_PART_H

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/search/search_options.h"

namespace stride::cli {

/// Runs those of the range that have no record. Others may be at work in the folder, so it is not
/// locked, and no table is made. Throws core::Error (Input) for a range that goes beyond the
/// present generation, whose cases are not known yet, and core::Error (Run) if some have not
/// passed.
void run_search_part(const SearchArguments& arguments, const CampaignInput& input);

/// Prints which cases of the present generation have no record; writes nothing.
void print_next_cases(const SearchArguments& arguments, const CampaignInput& input);

}  // namespace stride::cli

#endif
