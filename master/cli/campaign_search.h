// stride campaign search and shrink: the case that fails, and what of it is needed for that.
#ifndef STRIDE_MASTER_CLI_CAMPAIGN_SEARCH_H
#define STRIDE_MASTER_CLI_CAMPAIGN_SEARCH_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_campaign_search(CLI::App& group);
void add_campaign_shrink(CLI::App& group);

}  // namespace stride::cli

#endif
