// The verdicts on a run: table, failures and exit code.
#ifndef STRIDE_MASTER_CLI_VERDICTS_H
#define STRIDE_MASTER_CLI_VERDICTS_H

#include <span>
#include <string>

#include "master/algorithm/verdict.h"

namespace stride::cli {

/// A table with its title, of the units and of the scenario's checks; empty if there are none.
std::string verdict_table(std::span<const core::Verdict> verdicts);

/// A line for each bad verdict, with its first instant and the values there.
std::string failures_text(std::span<const core::Verdict> verdicts);

/// Throws core::Error (Run) that names each bad verdict.
void require_passed(std::span<const core::Verdict> verdicts);

}  // namespace stride::cli

#endif
