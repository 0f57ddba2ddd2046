// What stride check says of units on other machines.
#ifndef STRIDE_MASTER_FRONT_CLI_CHECK_REMOTE_CHECK_H
#define STRIDE_MASTER_FRONT_CLI_CHECK_REMOTE_CHECK_H

#include <string>

#include "master/system/plan/run_plan.h"

namespace stride::cli {

/// A table of the machines, each of which is tried, and what their distance costs this scenario at
/// least; empty if there are none. Throws core::Error for one that does not answer.
std::string remote_table(const scenario::RunPlan& loaded);

}  // namespace stride::cli

#endif
