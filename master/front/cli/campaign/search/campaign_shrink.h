// stride campaign shrink: what of a failing case is needed for its failure.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_CAMPAIGN_SHRINK_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_CAMPAIGN_SHRINK_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_campaign_shrink(CLI::App& group);

}  // namespace stride::cli

#endif
