// Digests of files, each of which is read once.
#ifndef STRIDE_MASTER_BASE_FILES_FILE_DIGESTS_H
#define STRIDE_MASTER_BASE_FILES_FILE_DIGESTS_H

#include <filesystem>
#include <map>
#include <string>

namespace stride::core {

/// Keeps what it has found: what changes behind that is not seen.
class FileDigests {
 public:
  /// sha256_of_folder() or sha256_of_file(). Throws as they do.
  const std::string& of(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, std::string> known_;
};

}  // namespace stride::core

#endif
