// A unit's shared library and the functions in it: those of FMI 3.0 and of <stride/idle.h>.
#ifndef STRIDE_MASTER_FMI_LIBRARY_H
#define STRIDE_MASTER_FMI_LIBRARY_H

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include <stride/fmi3.h>
#include <stride/idle.h>
#include <stride/self_description.h>

#include "master/core/error.h"

namespace stride::fmi {

/// The FMI 3.0 platform tuple of this build, "x86_64-linux": the name of the folder in binaries/.
const char* platform();

/// Where the library of this name stands in an unpacked FMU. Throws core::Error of the kind Input
/// that lists the platforms that there are, if it is not built for this one.
std::filesystem::path find_library(const std::filesystem::path& fmu_folder,
                                   const std::string& model_identifier,
                                   const core::Location& where = {});

/// The entry table: a pointer for each fmi3<Name>, null if the library does not have it.
struct Functions {
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

/// A loaded library; unloaded with the object, unless it is condemned.
class Library {
 public:
  /// Loads it with all its symbols resolved and kept to itself (RTLD_NOW, RTLD_LOCAL). Throws
  /// core::Error of the kind Input that names the shared library, the symbol or the FMI function
  /// that is missing. Functions of the other interface types and optional capabilities may be.
  explicit Library(const std::filesystem::path& path, const core::Location& where = {});
  ~Library();

  const std::filesystem::path& path() const { return path_; }
  const Functions& functions() const { return functions_; }
  const IdleFunctions& idle_functions() const { return idle_functions_; }
  /// Throws core::Error of the kind Input that names the functions of idle skipping that are
  /// missing, for a unit whose manifest says that it has them.
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

  /// To be said when an instance has returned fmi3Fatal: after it no function of any instance may
  /// be called (FMI 3.0, 2.2.3). Holds for all objects of the same library, until the process ends.
  void condemn() const { *is_condemned_ = true; }
  const std::atomic<bool>& is_condemned() const { return *is_condemned_; }

 private:
  struct Closer {
    void operator()(void* handle) const;
  };

  /// `function`: one of <stride/self_description.h>.
  std::string ask(strideModelDescriptionTYPE* function, const std::filesystem::path& resources,
                  const core::Location& where) const;

  std::filesystem::path path_;
  std::unique_ptr<void, Closer> handle_;
  std::atomic<bool>* is_condemned_ = nullptr;
  Functions functions_;
  IdleFunctions idle_functions_;
  strideModelDescriptionTYPE* self_description_ = nullptr;
  strideIdleManifestTYPE* idle_manifest_ = nullptr;
};

/// A folder of resources as FMI 3.0 passes it: an absolute native path with the separator at its
/// end; empty if there is no such folder.
std::string resource_path(const std::filesystem::path& resources);

}  // namespace stride::fmi

#endif
