#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_UNPACKED_FMU_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_UNPACKED_FMU_H

#include <filesystem>
#include <string>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/archive/zip.h"

namespace stride::importer {

/// The folder of an FMU: a `.fmu` archive unpacked into a temporary folder that goes with this
/// object, or a folder that is used where it is.
class UnpackedFmu {
 public:
  /// Throws core::Error of the kind Input, located at `where` (the line that names the FMU), for
  /// what is no archive, as UnpackedArchive does, and for one without a modelDescription.xml. One
  /// in another case, or in the only folder that has one, is taken with a warning(). `shown_as` is
  /// its path in messages, if that is another one.
  explicit UnpackedFmu(const std::filesystem::path& path, const core::Location& where = {},
                       const std::filesystem::path& shown_as = {},
                       const archive::UnpackLimits& limits = {});

  /// Which has the description at its top.
  std::filesystem::path folder() const { return description_.parent_path(); }
  /// Of the archive, or the folder as it was given.
  const std::filesystem::path& root() const { return archive_.folder(); }
  const std::filesystem::path& description() const { return description_; }
  /// Of what is packed in another way than the standard has it; or empty.
  const std::string& warning() const { return warning_; }

 private:
  archive::UnpackedArchive archive_;
  std::filesystem::path description_;
  std::string warning_;
};

/// Adds all files of the FMU, with its description where the standard has it.
void add_fmu(archive::Contents& contents, const UnpackedFmu& fmu);

}  // namespace stride::importer

#endif
