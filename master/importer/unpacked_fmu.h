#ifndef STRIDE_MASTER_IMPORTER_UNPACKED_FMU_H
#define STRIDE_MASTER_IMPORTER_UNPACKED_FMU_H

#include <filesystem>

#include "master/util/archive/unpacked_archive.h"

namespace stride::importer {

/// The folder of an FMU: a `.fmu` archive unpacked into a temporary folder that goes with this
/// object, or a folder that is used where it is.
class UnpackedFmu {
 public:
  /// Throws core::Error of the kind Input, located at `where` (the line that names the FMU), for
  /// what is no archive, as UnpackedArchive does, and for one without a modelDescription.xml at its
  /// top. `shown_as` is its path in messages, if that is another one.
  explicit UnpackedFmu(const std::filesystem::path& path, const core::Location& where = {},
                       const std::filesystem::path& shown_as = {});

  const std::filesystem::path& folder() const { return archive_.folder(); }

 private:
  archive::UnpackedArchive archive_;
};

}  // namespace stride::importer

#endif
