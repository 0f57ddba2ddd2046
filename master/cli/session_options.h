#ifndef STRIDE_MASTER_CLI_SESSION_OPTIONS_H
#define STRIDE_MASTER_CLI_SESSION_OPTIONS_H

#include "master/cli/session.h"

namespace CLI {
class App;
}

namespace stride::cli {

/// The options that every command on a scenario has. `request` must outlive the command line.
void add_session_options(CLI::App& command, SessionRequest& request);

}  // namespace stride::cli

#endif
