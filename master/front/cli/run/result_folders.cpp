#include "master/front/cli/run/result_folders.h"

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/front/cli/run/branches.h"
#include "master/front/cli/run/checkpoints.h"
#include "master/observe/recorders/unit_folders.h"

namespace stride::cli {

void refuse_result_folders(const std::filesystem::path& folder, const results::OutputPath& output) {
  if (recorders::is_in_unit_folders(folder, output.file)) {
    core::fail_input(
        {}, fmt::format("{}: the file is in the folder of the files of units", output.option),
        "choose a file elsewhere; units write to that folder");
  }
  results::refuse_folders(output, folder, {kCheckpointsFolder, kBranchesFolder}, "the results");
}

}  // namespace stride::cli
