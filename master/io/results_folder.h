#ifndef STRIDE_MASTER_IO_RESULTS_FOLDER_H
#define STRIDE_MASTER_IO_RESULTS_FOLDER_H

#include <filesystem>
#include <vector>

#include "master/io/annotation.h"

namespace stride::io {

/// Makes the folder, and those above it, where they do not exist. Throws core::Error (Input) if
/// that is not possible, or if it is no folder in which files can be written. A film that an
/// earlier run has left there goes, since it would be taken for one of the next run.
void make_results_folder(const std::filesystem::path& folder);

/// The paths of what is in the folder, sorted: none, or not all, where it cannot be read.
std::vector<std::filesystem::path> folder_entries(const std::filesystem::path& folder);

/// What an earlier run told of itself in the end, its statistics and its report, goes before the
/// next one writes its signals, to which it would be taken to belong if that run is killed.
void remove_conclusions(const std::filesystem::path& folder, const ResultFiles& files);

}  // namespace stride::io

#endif
