// What an archive should have at its top, and has elsewhere.
#ifndef STRIDE_MASTER_BASE_ARCHIVE_DISPLACED_FILE_H
#define STRIDE_MASTER_BASE_ARCHIVE_DISPLACED_FILE_H

#include <filesystem>
#include <string>
#include <vector>

namespace stride::archive {

/// What is in the folder, in the order of names, but for what macOS adds to archives and hidden
/// files: "__MACOSX", ".DS_Store".
std::vector<std::filesystem::path> packed_entries(const std::filesystem::path& folder);

/// The file of this name that an archive, unpacked to `folder`, is for: at its top, also in another
/// case, or else in those folders of it, less deep than others, that have one, since the folder was
/// packed and not what is in it. Empty if there is none.
std::vector<std::filesystem::path> find_files(const std::filesystem::path& folder,
                                              const std::string& name);

/// "'FILE' has its NAME as 'top/NAME'; …"
std::string displaced_text(const std::string& shown_as, const std::string& name,
                           const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace stride::archive

#endif
