// Access to files where another process may replace them by links at any moment.
#ifndef STRIDE_MASTER_BASE_FILES_UNTRUSTED_FOLDER_H
#define STRIDE_MASTER_BASE_FILES_UNTRUSTED_FOLDER_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "master/base/files/descriptor.h"

namespace stride::core {

using FileStream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A folder below which processes without trust may write, also at this moment. No link is followed
/// below it, so nothing outside of it is reached; the path of the folder itself may contain links.
/// Files are named by relative paths without ".." and ".".
class UntrustedFolder {
 public:
  /// Where there is no such folder, there are no files.
  explicit UntrustedFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// Opens a regular file to read it. Null, with the reason in errno, where there is none: ENOENT
  /// if there is nothing of this name, something else for links, FIFOs and the like.
  FileStream open(const std::filesystem::path& file) const;
  /// [byte]; nothing, with errno, as for open().
  std::optional<std::uintmax_t> size(const std::filesystem::path& file) const;
  /// The content; nothing if the file cannot be opened or read, or has more than `most` bytes.
  std::optional<std::string> read(const std::filesystem::path& file, std::size_t most) const;

  /// Removes all links, FIFOs, sockets and devices below the folder. Throws Error (Input) if one
  /// stays, or if a folder cannot be searched.
  void remove_special_files() const;

 private:
  std::filesystem::path path_;
  Descriptor folder_;
};

}  // namespace stride::core

#endif
