// Units' libraries that cannot be unloaded.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_KEPT_LIBRARIES_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_KEPT_LIBRARIES_H

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "master/loader/fmu/library/shared_library.h"
#include "master/loader/fmu/library/unpacked_fmu.h"

namespace stride::importer {

/// Each stays in the process once, with the files that it was loaded from, and is used again where
/// an FMU with the same content is simulated next: otherwise each simulation would leave one.
class KeptLibraries {
 public:
  /// Those of this process.
  static KeptLibraries& of_process();

  /// `digest`: of the archive of the FMU. Another library of it is kept already: nothing happens.
  void keep(const std::string& digest, std::shared_ptr<const SharedLibrary> library,
            std::shared_ptr<const UnpackedFmu> files);
  /// Null if there is none.
  std::shared_ptr<const SharedLibrary> find(const std::string& digest) const;
  bool is_empty() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const SharedLibrary>> libraries_;
};

}  // namespace stride::importer

#endif
