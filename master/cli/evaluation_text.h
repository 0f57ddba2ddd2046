#ifndef STRIDE_MASTER_CLI_EVALUATION_TEXT_H
#define STRIDE_MASTER_CLI_EVALUATION_TEXT_H

#include <string>

#include "master/model/system.h"

namespace stride::cli {

/// The order in which initial values are evaluated, as a table.
std::string initial_order_text(const core::System& system);

/// The algebraic loops at the start and at events: their paths, their
/// unknowns, and whether they follow only from dependencies that units do not declare.
std::string loops_text(const core::System& system);

}  // namespace stride::cli

#endif
