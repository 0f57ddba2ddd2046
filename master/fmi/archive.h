#ifndef STRIDE_MASTER_FMI_ARCHIVE_H
#define STRIDE_MASTER_FMI_ARCHIVE_H

#include <cstdint>
#include <filesystem>
#include <optional>

#include "master/core/error.h"
#include "master/fmi/temporary_folder.h"

namespace stride::fmi {

/// What an archive may grow to, so that a small malicious file cannot fill the disk.
struct UnpackLimits {
  std::uint64_t bytes = std::uint64_t{4} << 30;  ///< all files together, unpacked
  std::uint64_t entries = 100'000;
};

/// The folder of an FMU: a `.fmu` archive unpacked into a temporary folder that goes with this
/// object, or a folder that is used where it is.
class UnpackedFmu {
 public:
  /// Throws core::Error of the kind Input, located at `where` (the line that names the FMU), for
  /// what is no zip archive, has no modelDescription.xml at its top, is larger than the limits, or
  /// holds an entry that could reach out of the folder: an absolute path, `..`, a link or a device.
  /// Nothing is ever written outside of the folder.
  explicit UnpackedFmu(const std::filesystem::path& path, const core::Location& where = {},
                       const UnpackLimits& limits = {});

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::optional<TemporaryFolder> temporary_;
  std::filesystem::path folder_;
};

}  // namespace stride::fmi

#endif
