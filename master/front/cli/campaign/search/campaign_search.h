// stride campaign search: the case that fails.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_CAMPAIGN_SEARCH_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_CAMPAIGN_SEARCH_H

#include <string>

namespace CLI {
class App;
}

namespace stride::campaign {
class CampaignScenario;
}

namespace stride::cli {

/// Throws core::Error (Input) for a scenario without checks, whose margins are what a search is
/// led by, and for one without a check of this name; an empty name is none.
void require_check(const campaign::CampaignScenario& scenario, const std::string& name);

void add_campaign_search(CLI::App& group);

}  // namespace stride::cli

#endif
