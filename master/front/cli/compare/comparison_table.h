#ifndef STRIDE_MASTER_FRONT_CLI_COMPARE_COMPARISON_TABLE_H
#define STRIDE_MASTER_FRONT_CLI_COMPARE_COMPARISON_TABLE_H

#include <string>

#include "master/study/compare/compare.h"

namespace stride::cli {

/// What `stride compare` prints: where the results differ first, a table of the differences and one
/// of the inputs, each of a bounded length, and what was not compared.
std::string comparison_text(const compare::Comparison& comparison);

}  // namespace stride::cli

#endif
