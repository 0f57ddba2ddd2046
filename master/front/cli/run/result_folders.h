// The folders in that of the results.
#ifndef STRIDE_MASTER_FRONT_CLI_RUN_RESULT_FOLDERS_H
#define STRIDE_MASTER_FRONT_CLI_RUN_RESULT_FOLDERS_H

#include <filesystem>

#include "master/study/results/output_paths.h"

namespace stride::cli {

/// Throws core::Error (Input) if an output is in a folder of `folder`: that of the files of units,
/// where a unit could put a link, which would be followed, and those of checkpoints and branches.
void refuse_result_folders(const std::filesystem::path& folder, const results::OutputPath& output);

}  // namespace stride::cli

#endif
