// An FMI 1.0 unit's library.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI1_LIBRARY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI1_LIBRARY_H

#include <filesystem>
#include <string>

#include <stride/fmi1.h>

#include "master/base/error.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::importer {

/// The entry table: a pointer for each <id>_fmi<Name>, null if the library does not have it.
struct Fmi1Functions {
#define STRIDE_POINTER(name) fmi1##name##TYPE* name = nullptr;
  FMI1_FUNCTIONS(STRIDE_POINTER)
#undef STRIDE_POINTER
};

class Fmi1Library : public SharedLibrary {
 public:
  /// Throws as SharedLibrary does, where a function is missing that any stand-alone Co-Simulation
  /// unit must have, and where it was compiled for other platform types than those of
  /// <stride/fmi1.h>.
  Fmi1Library(const std::filesystem::path& path, const std::string& model_identifier,
              core::Context user = {}, const std::filesystem::path& shown_as = {});

  const Fmi1Functions& functions() const { return functions_; }
  /// Throws core::Error (Input) where it does not export what this unit needs further.
  void require_functions(const core::UnitDescription& unit) const;

 private:
  std::string prefix_;  ///< of its functions
  Fmi1Functions functions_;
};

}  // namespace stride::importer

#endif
