// What files were at one moment.
#ifndef STRIDE_MASTER_BASE_FILES_FILE_STAMPS_H
#define STRIDE_MASTER_BASE_FILES_FILE_STAMPS_H

#include <filesystem>
#include <map>
#include <optional>

#include <sys/stat.h>

#include "master/base/files/file_identity.h"

namespace stride::core {

/// To see later whether they are still that, without reading them.
class FileStamps {
 public:
  /// A file, or a folder with all that is in it, of which it counts only that it is there: its
  /// files may be another's to write to. What does not exist is left out.
  void add(const std::filesystem::path& path);

  /// One that is gone or, a file that was added, not the same: another one is in its place, or its
  /// size or the time of its last change is another.
  std::optional<std::filesystem::path> changed() const;

 private:
  struct Stamp {
    FileIdentity identity;
    off_t size = 0;
    std::int64_t time = 0;  ///< [ns]
    bool operator==(const Stamp&) const = default;
  };
  static std::optional<Stamp> stamp_of(const std::filesystem::path& path);

  /// Without a stamp: in a folder.
  std::map<std::filesystem::path, std::optional<Stamp>> stamps_;
};

}  // namespace stride::core

#endif
