#ifndef STRIDE_MASTER_LOADER_FMU_FMU_H
#define STRIDE_MASTER_LOADER_FMU_FMU_H

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "master/base/files/file_stamps.h"
#include "master/engine/port/unit.h"
#include "master/loader/fmu/description/description_file.h"
#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/instance/fmu_instance.h"
#include "master/loader/fmu/library/fmi1_library.h"
#include "master/loader/fmu/library/fmi2_library.h"
#include "master/loader/fmu/library/fmi3_library.h"
#include "master/loader/fmu/library/unpacked_fmu.h"

namespace stride::importer {

/// A unit on disk, of which instances can be made. Each of
///
/// - a `.fmu` archive,
/// - the folder that such an archive unpacks to,
/// - a bare library (`.so`) made with the unit kit, which describes itself; its resources are the
///   folder `resources` beside it, if there is one.
class Fmu : public std::enable_shared_from_this<Fmu> {
 public:
  /// Reads the description; the library of an archive or folder is not loaded yet, so units of
  /// other platforms can be inspected. Throws core::Error of the kind Input; `where` is the place
  /// that names the unit, and `shown_as` its path in messages, if that is another one.
  static std::shared_ptr<Fmu> load(const std::filesystem::path& path,
                                   const core::Location& where = {},
                                   const std::filesystem::path& shown_as = {},
                                   const archive::UnpackLimits& limits = {});

  /// Keeps a library that cannot be unloaded: see KeptLibraries.
  ~Fmu();

  /// As it is shown in messages.
  const std::filesystem::path& path() const { return shown_as_; }
  std::shared_ptr<const core::UnitDescription> description() const { return description_; }

  /// Its description as files, for where its library is not needed: an FMU of these alone has the
  /// same description. Throws core::Error of the kind Input.
  std::vector<DescriptionFile> description_files() const;

  /// Where its files are: the unpacked archive, or the folder itself. Empty for a bare library.
  std::filesystem::path folder() const {
    return unpacked_ ? unpacked_->folder() : std::filesystem::path();
  }

  /// Where its resources are, if it has any: the folder need not exist.
  const std::filesystem::path& resources() const { return resources_; }

  /// Loads the library, if that has not happened yet. Throws core::Error of the kind Input.
  std::shared_ptr<const SharedLibrary> load_library();
  /// Likewise of a unit of this version; null if it is of the other.
  std::shared_ptr<const Fmi1Library> load_fmi1_library();
  std::shared_ptr<const Fmi2Library> load_fmi2_library();
  std::shared_ptr<const Fmi3Library> load_fmi3_library();

  /// Unloads the library, as the destructor does, unless instances or others use it.
  void unload_library();

  /// Makes an instance, which keeps this object alive. Throws core::Error: Input if the library
  /// does not load, or if a second instance of a unit is asked for that allows one per process
  /// only; Run if the unit refuses.
  std::unique_ptr<core::Unit> instantiate(const std::string& name, InstanceOptions options = {});

 private:
  Fmu(std::filesystem::path path, core::Location where, std::filesystem::path shown_as);
  void read_folder(const archive::UnpackLimits& limits);
  void read_bare_library();
  void load_library_for(const std::string& component, const LogSink& log);
  void warn_of_library(const std::string& name, const InstanceOptions& options);
  /// The library of this version. Called with the lock.
  template <class Library>
  void load_once(std::shared_ptr<const Library>& library);
  bool may_keep_library() const;

  std::filesystem::path path_;
  std::filesystem::path shown_as_;
  core::Location where_;
  std::shared_ptr<const UnpackedFmu> unpacked_;
  core::FileStamps archive_;  ///< the file, when it was unpacked
  std::filesystem::path resources_;
  std::shared_ptr<const ModelDescription> description_;
  std::vector<DescriptionFile> own_files_;  ///< of a bare library, which has given them
  std::mutex library_mutex_;
  std::string first_component_;  ///< of which an instance was wanted
  std::shared_ptr<const Fmi1Library> fmi1_library_;
  std::shared_ptr<const Fmi2Library> fmi2_library_;
  std::shared_ptr<const Fmi3Library> fmi3_library_;
  std::string library_warning_;  ///< when it is loaded
  std::atomic<bool> has_warned_of_library_ = false;
  std::atomic<std::size_t> instances_ = 0;  ///< made so far
};

}  // namespace stride::importer

#endif
