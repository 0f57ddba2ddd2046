// stride campaign submit.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_SUBMIT_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CAMPAIGN_SUBMIT_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_campaign_submit(CLI::App& group);

}  // namespace stride::cli

#endif
