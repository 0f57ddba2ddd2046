// stride campaign run and status.
#ifndef STRIDE_MASTER_CLI_CAMPAIGN_RUN_H
#define STRIDE_MASTER_CLI_CAMPAIGN_RUN_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_campaign_run(CLI::App& group);
void add_campaign_status(CLI::App& group);

}  // namespace stride::cli

#endif
