// What the units' verdicts mean to who runs a scenario.
#ifndef STRIDE_MASTER_CLI_VERDICTS_H
#define STRIDE_MASTER_CLI_VERDICTS_H

#include <span>
#include <string>

#include "master/core/system.h"
#include "master/core/verdict.h"

namespace stride::cli {

/// A table with its title; empty if no unit has a verdict.
std::string verdict_table(const core::System& system, std::span<const core::Verdict> verdicts);

/// Throws core::Error (Run), which names each unit whose verdict is that the run has failed.
void require_passed(const core::System& system, std::span<const core::Verdict> verdicts);

}  // namespace stride::cli

#endif
