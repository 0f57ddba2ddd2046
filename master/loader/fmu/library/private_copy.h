// An FMU whose libraries have names that no other library in the process has.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_PRIVATE_COPY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_PRIVATE_COPY_H

#include <filesystem>
#include <set>
#include <string>

#include "master/base/archive/temporary_folder.h"
#include "master/loader/fmu/library/needed_libraries.h"

namespace stride::importer {

/// The loader takes libraries of one name for the same, so a unit would get what another one has
/// brought along. Here is its FMU again, in a temporary folder of links, with copies of its
/// libraries in which the names of those that it brings along are others, of the same length.
class PrivateCopy {
 public:
  /// `own`: symbols that exist once per process, and in the copy once in each library. Throws
  /// core::Error, or std::filesystem::filesystem_error, if it cannot be made.
  PrivateCopy(const UnitLibraries& libraries, const std::set<std::string>& own);

  /// The unit's library.
  const std::filesystem::path& library() const { return library_; }

 private:
  archive::TemporaryFolder folder_;
  std::filesystem::path library_;
};

}  // namespace stride::importer

#endif
