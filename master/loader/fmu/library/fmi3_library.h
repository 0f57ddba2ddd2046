// An FMI 3.0 unit's library: the functions of FMI 3.0, of <stride/idle.h> and of
// <stride/describe.h>.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI3_LIBRARY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_FMI3_LIBRARY_H

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>
#include <stride/self_description.h>

#include "master/base/error.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::importer {

/// The entry table: a pointer for each fmi3<Name>, null if the library does not have it.
struct Fmi3Functions {
#define STRIDE_POINTER(name) fmi3##name##TYPE* name = nullptr;
  FMI3_FUNCTIONS(STRIDE_POINTER)
#undef STRIDE_POINTER
};

/// Likewise that of idle skipping, stride<Name>.
struct IdleFunctions {
#define STRIDE_POINTER(name) stride##name##TYPE* name = nullptr;
  STRIDE_IDLE_FUNCTIONS(STRIDE_POINTER)
#undef STRIDE_POINTER
};

/// Likewise those for the text of messages.
struct DescribeFunctions {
#define STRIDE_POINTER(name) stride##name##TYPE* name = nullptr;
  STRIDE_DESCRIBE_FUNCTIONS(STRIDE_POINTER)
#undef STRIDE_POINTER
};

/// What any Co-Simulation unit must have, without the "fmi3" before it.
std::span<const std::string_view> fmi3_needed_functions();

class Fmi3Library : public SharedLibrary {
 public:
  /// Throws as SharedLibrary does, and where an FMI function is missing. Functions of the other
  /// interface types and optional capabilities may be. With a model identifier they are found by
  /// their names in a static library, too.
  explicit Fmi3Library(const std::filesystem::path& path, const std::string& model_identifier = "",
                       core::Context user = {}, const std::filesystem::path& shown_as = {});

  const Fmi3Functions& functions() const { return functions_; }
  /// Throws core::Error (Input) where it does not export what this unit needs further.
  void require_functions(const core::UnitDescription& unit) const;
  const IdleFunctions& idle_functions() const { return idle_functions_; }
  const DescribeFunctions& describe_functions() const { return describe_functions_; }
  /// Throws core::Error of the kind Input that names the functions of idle skipping that are
  /// missing, for a unit whose manifest declares them.
  void require_idle_functions(const core::Location& where = {}) const;

  /// Whether the library was made with the unit kit, and so knows its own model description.
  bool describes_itself() const { return self_description_ != nullptr; }
  /// The text of its modelDescription.xml with these resources (empty: none). Throws core::Error of
  /// the kind Input if it cannot.
  std::string describe(const std::filesystem::path& resources,
                       const core::Location& where = {}) const;
  /// Likewise that of its manifest of idle skipping; empty if it never promises to be idle.
  std::string idle_manifest(const std::filesystem::path& resources,
                            const core::Location& where = {}) const;

 private:
  /// `function`: one of <stride/self_description.h>.
  std::string text_from(strideModelDescriptionTYPE* function,
                        const std::filesystem::path& resources, const core::Location& where) const;

  Fmi3Functions functions_;
  IdleFunctions idle_functions_;
  DescribeFunctions describe_functions_;
  strideModelDescriptionTYPE* self_description_ = nullptr;
  strideIdleManifestTYPE* idle_manifest_ = nullptr;
};

/// A folder of resources as FMI 3.0 passes it: an absolute native path with the separator at its
/// end; empty if there is no such folder.
std::string resource_path(const std::filesystem::path& resources);

}  // namespace stride::importer

#endif
