#ifndef STRIDE_MASTER_RECORDERS_RESULTS_FOLDER_H
#define STRIDE_MASTER_RECORDERS_RESULTS_FOLDER_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/recorders/result_files.h"

namespace stride::io {

/// Where units put their films, each into a folder of its own, and the list of its pictures there.
inline constexpr const char* kFilmFolder = "film";
inline constexpr const char* kFilmList = "frames.csv";

/// Whether it names a file in the results folder itself.
bool is_plain_file_name(const std::string& name);

/// Makes the folder, and those above it, where they do not exist. Throws core::Error (Input) if
/// that is not possible, or if it is no folder in which files can be written.
void make_results_folder(const std::filesystem::path& folder);

/// The paths of what is in the folder, sorted: none, or not all, where it cannot be read.
std::vector<std::filesystem::path> folder_entries(const std::filesystem::path& folder);

/// The films and the files of these names that an earlier run has left go before the next one
/// begins: what that does not write itself, or not before it is killed, would be taken for its own.
void remove_results(const std::filesystem::path& folder, const ResultFiles& files);

}  // namespace stride::io

#endif
