// The systems of a package.
#ifndef STRIDE_MASTER_FRONT_CLI_INSPECT_VARIANTS_H
#define STRIDE_MASTER_FRONT_CLI_INSPECT_VARIANTS_H

#include <filesystem>
#include <string>

#include "master/system/ssp/files.h"

namespace stride::cli {

/// A table with its title, with the one of the scenario marked; empty unless the scenario is in a
/// package with several.
std::string variant_table(ssp::Files& files, const std::filesystem::path& scenario);

}  // namespace stride::cli

#endif
