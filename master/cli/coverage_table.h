// What is printed of coverage.
#ifndef STRIDE_MASTER_CLI_COVERAGE_TABLE_H
#define STRIDE_MASTER_CLI_COVERAGE_TABLE_H

#include <span>
#include <string>
#include <vector>

#include "master/coverage/definition.h"
#include "master/coverage/report.h"
#include "master/recorders/run_json.h"

namespace stride::cli {

/// With its title: the groups with their points.
std::string coverage_table(const coverage::Report& report);
/// Likewise of what is to be covered.
std::string coverage_table(std::span<const coverage::GroupDefinition> groups);
/// With its title: the bins that count and do not have their visits; empty if there are none.
std::string missing_table(const coverage::Report& report);

std::vector<recorders::CoverageSummary> coverage_summaries(const coverage::Report& report);

}  // namespace stride::cli

#endif
