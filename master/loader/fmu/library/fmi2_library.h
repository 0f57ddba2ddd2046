// An FMI 2.0 unit's library.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI2_LIBRARY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI2_LIBRARY_H

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <stride/fmi2.h>

#include "master/base/error.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::importer {

/// The entry table: a pointer for each fmi2<Name>, null if the library does not have it.
struct Fmi2Functions {
#define STRIDE_POINTER(name) fmi2##name##TYPE* name = nullptr;
  FMI2_FUNCTIONS(STRIDE_POINTER)
#undef STRIDE_POINTER
};

/// What any Co-Simulation unit must have, without the "fmi2" before it.
std::span<const std::string_view> fmi2_needed_functions();

class Fmi2Library : public SharedLibrary {
 public:
  /// Throws as SharedLibrary does, where a function is missing that any Co-Simulation unit must
  /// have, also by its name in a static library, and where it was compiled for other platform types
  /// than those of <stride/fmi2.h>.
  Fmi2Library(const std::filesystem::path& path, const std::string& model_identifier,
              core::Context user = {}, const std::filesystem::path& shown_as = {});

  const Fmi2Functions& functions() const { return functions_; }
  /// Throws core::Error (Input) where it does not export what this unit needs further.
  void require_functions(const core::UnitDescription& unit) const;

 private:
  Fmi2Functions functions_;
};

}  // namespace stride::importer

#endif
