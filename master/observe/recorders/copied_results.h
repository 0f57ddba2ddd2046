#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_COPIED_RESULTS_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_COPIED_RESULTS_H

#include <filesystem>

#include "master/observe/recorders/results_folder.h"

namespace stride::recorders {

/// Copies the files of these names that are there and that a run writes on. Throws core::Error: of
/// the kind Input for what cannot be read, of the kind Run for what cannot be written.
void copy_records(const std::filesystem::path& from, const std::filesystem::path& to,
                  const ResultFiles& files);

/// Copies the folders of units, without links. Throws likewise.
void copy_unit_files(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace stride::recorders

#endif
