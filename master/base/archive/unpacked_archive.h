// What is packed in a zip archive, as a folder.
#ifndef STRIDE_MASTER_BASE_ARCHIVE_UNPACKED_ARCHIVE_H
#define STRIDE_MASTER_BASE_ARCHIVE_UNPACKED_ARCHIVE_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "master/base/archive/temporary_folder.h"
#include "master/base/error.h"

namespace stride::archive {

/// What an archive may grow to, so that a small malicious file cannot fill the disk.
struct UnpackLimits {
  std::uint64_t bytes = std::uint64_t{4} << 30;  ///< all files together, unpacked
  std::uint64_t entries = 100'000;
  /// For who has one that grows to more.
  std::string hint = "unpack it yourself and name the folder instead, if you trust it";
};

/// A zip archive unpacked into a temporary folder that goes with this object, or a folder that is
/// used where it is.
class UnpackedArchive {
 public:
  /// Throws core::Error of the kind Input, located at `where` (the line that names the archive),
  /// for what is no regular file or no zip archive, is larger than the limits, or holds an entry
  /// that could reach out of the folder: an absolute path, `..`, a device, a link to what is no
  /// file of the archive; other links are files of their own. Nothing is
  /// ever written outside of the folder. `expected`: what the file should have been: "an FMU: a
  /// .fmu archive (zip), …". `shown_as`: its path in messages, if that is another one.
  UnpackedArchive(const std::filesystem::path& path, const std::string& expected,
                  const core::Location& where = {}, const UnpackLimits& limits = {},
                  const std::string& shown_as = "");

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::optional<TemporaryFolder> temporary_;
  std::filesystem::path folder_;
};

}  // namespace stride::archive

#endif
