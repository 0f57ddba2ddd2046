// Zip archives are written whole, from what is to be in them.
#ifndef STRIDE_MASTER_BASE_ARCHIVE_ZIP_H
#define STRIDE_MASTER_BASE_ARCHIVE_ZIP_H

#include <filesystem>
#include <map>
#include <string>

namespace stride::archive {

struct Content {
  std::string text;
  std::filesystem::path file;  ///< to be copied, instead of a text
  bool executable = false;
};

/// What is to be in an archive: name there -> content, so the archive's order is that of the names.
using Contents = std::map<std::string, Content>;

/// Throws core::Error (Input) for what is no file, and for a name that is there already.
void add_file(Contents& contents, const std::string& name, const std::filesystem::path& file,
              bool executable);

/// All files in a folder and below, with `prefix` before their names ("resources/"); what the
/// file system has as executable stays it. Throws core::Error (Input) for what is no folder,
/// and for one that holds a link to itself.
void add_folder(Contents& contents, const std::string& prefix, const std::filesystem::path& folder);

/// The archive depends on the contents alone: no time, no owner. It replaces a file that is there
/// when it is complete. Throws core::Error.
void write_zip(const std::filesystem::path& path, const Contents& contents);

}  // namespace stride::archive

#endif
