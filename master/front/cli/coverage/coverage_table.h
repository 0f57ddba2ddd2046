// What is printed of coverage.
#ifndef STRIDE_MASTER_FRONT_CLI_COVERAGE_COVERAGE_TABLE_H
#define STRIDE_MASTER_FRONT_CLI_COVERAGE_COVERAGE_TABLE_H

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/report.h"
#include "master/observe/recorders/run_json.h"

namespace stride::cli {

/// With its title: the groups with their points.
std::string coverage_table(const coverage::Report& report);
/// Likewise of what is to be covered.
std::string coverage_table(std::span<const coverage::GroupDefinition> groups);
/// With its title: the bins that count and do not have their visits; empty if there are none.
std::string missing_table(const coverage::Report& report);

/// With its title: the points that not all runs have alike, of how many runs and why; empty if
/// there are none. `where` says of a component and the definition of a point in which files it is.
using FilesOfPoints = std::map<std::pair<std::string, std::string>, std::string>;
std::string told_apart_table(const coverage::Report& report, const FilesOfPoints& where = {});

}  // namespace stride::cli

#endif
