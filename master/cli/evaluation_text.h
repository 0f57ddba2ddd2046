#ifndef STRIDE_MASTER_CLI_EVALUATION_TEXT_H
#define STRIDE_MASTER_CLI_EVALUATION_TEXT_H

#include <string>

#include "master/model/system.h"

namespace stride::cli {

/// In which order the initial values are evaluated: a table.
std::string initial_order_text(const core::System& system);

/// The algebraic loops at the start and at events: their paths, what they are solved for, and
/// whether they are there only because of what units leave undeclared.
std::string loops_text(const core::System& system);

}  // namespace stride::cli

#endif
