// stride campaign distil: a regression suite of a device, from the cases of a campaign.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_CAMPAIGN_DISTIL_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_DISTIL_CAMPAIGN_DISTIL_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_campaign_distil(CLI::App& group);

}  // namespace stride::cli

#endif
