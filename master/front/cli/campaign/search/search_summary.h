// What a search has found, in tables.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_SUMMARY_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_SUMMARY_H

#include <cstdint>
#include <string>
#include <vector>

#include "master/front/cli/campaign/search/listed_cases.h"
#include "master/study/campaign/campaign_scenario.h"
#include "master/study/search/search.h"

namespace stride::cli {

/// Failures, the least margin of each check, the parameters of the cases that these are of, and the
/// commands that repeat them. There is a case at least.
std::string search_tables(const search::Search& search, const ListedCases& cases,
                          const campaign::CampaignScenario& scenario);

/// How a parameter is called in a table: "arm.offset [mm]".
std::string parameter_title(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                            std::size_t column);
/// What a case without a value of its own has, as far as that is known: "0.5".
std::string nominal_text(const campaign::ValueKind& kind, std::optional<double> nominal);

}  // namespace stride::cli

#endif
