// Which file an open file or a path is.
#ifndef STRIDE_MASTER_BASE_FILES_FILE_IDENTITY_H
#define STRIDE_MASTER_BASE_FILES_FILE_IDENTITY_H

#include <optional>

#include <sys/stat.h>

namespace stride::core {

/// The same for all links and open files of one file, and for no other one that exists at the same
/// time. For signal handlers, too.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;

  static std::optional<FileIdentity> of(int descriptor) noexcept {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino};
  }
  static std::optional<FileIdentity> of(const char* path) noexcept {
    struct stat status {};
    if (::stat(path, &status) != 0) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino};
  }

  bool operator==(const FileIdentity&) const = default;
};

}  // namespace stride::core

#endif
