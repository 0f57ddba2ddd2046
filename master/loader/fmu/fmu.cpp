#include "master/loader/fmu/fmu.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/files/file_uri.h"
#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"
#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/description/idle_manifest.h"
#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/fmi1/fmi1_unit.h"
#include "master/loader/fmu/fmi2/fmi2_unit.h"
#include "master/loader/fmu/fmi3/fmi3_unit.h"
#include "master/loader/fmu/library/exported_functions.h"
#include "master/loader/fmu/library/kept_libraries.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// Instances of one FMU behave alike, and there may be 100,000 of them.
constexpr std::size_t kMostWatched = 64;

/// The units in use that allow one instance per process only, by their instantiation token: two
/// copies of the same archive are the same unit.
class SingleInstances {
 public:
  bool claim(const std::string& token) {
    const std::lock_guard lock(mutex_);
    return tokens_.insert(token).second;
  }
  void release(const std::string& token) {
    const std::lock_guard lock(mutex_);
    tokens_.erase(token);
  }

 private:
  std::mutex mutex_;
  std::set<std::string> tokens_;
};

SingleInstances& single_instances() {
  static SingleInstances instances;
  return instances;
}

/// Keeps the FMU alive, and its claim to be the only instance if it needs one.
class Tenancy {
 public:
  Tenancy(std::shared_ptr<const Fmu> fmu, const std::string& name, const core::Location& where)
      : fmu_(std::move(fmu)) {
    const core::UnitDescription& description = *fmu_->description();
    if (!description.single_instance) return;
    if (!single_instances().claim(description.instantiation_token)) {
      core::fail_input({.where = where, .unit = name},
                       fmt::format("'{}' can be instantiated only once per process, and an "
                                   "instance of it is there already",
                                   fmu_->path().string()),
                       fmt::format("run this one in a process of its own, <stride:Host "
                                   "components=\"{}\"/>, or use it for one component only",
                                   name));
    }
    token_ = description.instantiation_token;
  }
  ~Tenancy() {
    if (token_) single_instances().release(*token_);
  }
  Tenancy(const Tenancy&) = delete;
  Tenancy& operator=(const Tenancy&) = delete;

 private:
  std::shared_ptr<const Fmu> fmu_;
  std::optional<std::string> token_;
};

}  // namespace

std::shared_ptr<Fmu> Fmu::load(const fs::path& path, const core::Location& where,
                               const fs::path& shown_as, const archive::UnpackLimits& limits) {
  const std::shared_ptr<Fmu> fmu(new Fmu(path, where, shown_as.empty() ? path : shown_as));
  if (path.extension() == ".so" && core::is_file(path)) {
    fmu->read_bare_library();
  } else {
    fmu->read_folder(limits);
  }
  return fmu;
}

Fmu::Fmu(fs::path path, core::Location where, fs::path shown_as)
    : path_(std::move(path)), shown_as_(std::move(shown_as)), where_(std::move(where)) {}

void Fmu::read_folder(const archive::UnpackLimits& limits) {
  archive_.add(path_);
  unpacked_ = std::make_shared<const UnpackedFmu>(path_, where_, shown_as_, limits);
  resources_ = unpacked_->folder() / "resources";
  const fs::path inside = unpacked_->description().lexically_relative(unpacked_->root());
  auto description = std::make_shared<ModelDescription>(
      read_model_description(unpacked_->description(), (shown_as_ / inside).string()));
  if (!unpacked_->warning().empty()) {
    description->warnings.insert(description->warnings.begin(), unpacked_->warning());
  }
  const fs::path manifest = unpacked_->folder() / STRIDE_IDLE_MANIFEST;
  const bool is_fmi3 = !description->fmi1 && !description->fmi2;
  if (is_fmi3 && core::path_exists(manifest)) {  // its functions are in terms of FMI 3.0
    read_idle_manifest(manifest, (shown_as_ / STRIDE_IDLE_MANIFEST).string(), *description);
  }
  description_ = std::move(description);
}

void Fmu::read_bare_library() {
  fmi3_library_ =
      std::make_shared<Fmi3Library>(path_, "", core::Context{.where = where_}, shown_as_);
  resources_ = fs::absolute(path_).parent_path() / "resources";
  const std::string text = fmi3_library_->describe(resources_, where_);
  auto description = std::make_shared<ModelDescription>(
      parse_model_description(text, shown_as_.string() + ": its own description"));
  const std::string manifest = fmi3_library_->idle_manifest(resources_, where_);
  if (!manifest.empty()) {
    parse_idle_manifest(manifest, shown_as_.string() + ": its own idle manifest", *description);
  }
  own_files_.push_back({kDescriptionFiles[0], text});
  if (!manifest.empty()) own_files_.push_back({STRIDE_IDLE_MANIFEST, manifest});
  description_ = std::move(description);
}

std::vector<DescriptionFile> Fmu::description_files() const {
  if (!unpacked_) return own_files_;
  std::vector<DescriptionFile> files;
  for (const char* name : kDescriptionFiles) {
    const fs::path file = files.empty() ? unpacked_->description() : unpacked_->folder() / name;
    if (!core::path_exists(file)) continue;
    files.push_back({name, core::read_input(file, (shown_as_ / name).string())});
  }
  return files;
}

Fmu::~Fmu() {
  if (!may_keep_library()) return;
  const std::array<std::shared_ptr<const SharedLibrary>, 3> libraries{fmi1_library_, fmi2_library_,
                                                                      fmi3_library_};
  const auto library =
      std::ranges::find_if(libraries, [](const auto& one) { return one != nullptr; });
  if (library == libraries.end() || (*library)->is_unusable() || (*library)->can_be_unloaded())
    return;
  try {
    if (archive_.changed()) return;
    KeptLibraries::of_process().keep(core::sha256_of_file(path_), *library, unpacked_);
  } catch (const std::exception&) {  // the archive is not there any more
  }
}

/// A folder's is the same file each time, and so is in the process once. One that allows one
/// instance per process is not used again.
bool Fmu::may_keep_library() const {
  return unpacked_ && description_ && !description_->single_instance && core::is_file(path_);
}

template <class Library>
void Fmu::load_once(std::shared_ptr<const Library>& library) {
  if (library) return;
  const KeptLibraries& kept = KeptLibraries::of_process();
  if (!kept.is_empty() && may_keep_library()) {
    library = std::static_pointer_cast<const Library>(kept.find(core::sha256_of_file(path_)));
    if (library) return;
  }
  const core::Context user{.where = where_, .unit = first_component_};
  const FoundLibrary found = find_library(unpacked_->folder(), description_->fmi_version,
                                          description_->model_identifier, user);
  library_warning_ = found.warning;
  const fs::path shown_as = shown_as_ / found.path.lexically_relative(unpacked_->root());
  const auto loaded =
      std::make_shared<Library>(found.path, description_->model_identifier, user, shown_as);
  loaded->require_functions(*description_);
  library = loaded;
}

std::shared_ptr<const SharedLibrary> Fmu::load_library() {
  if (description_->fmi1) return load_fmi1_library();
  if (description_->fmi2) return load_fmi2_library();
  return load_fmi3_library();
}

std::shared_ptr<const Fmi1Library> Fmu::load_fmi1_library() {
  const std::lock_guard lock(library_mutex_);
  if (description_->fmi1) load_once(fmi1_library_);
  return fmi1_library_;
}

std::shared_ptr<const Fmi2Library> Fmu::load_fmi2_library() {
  const std::lock_guard lock(library_mutex_);
  if (description_->fmi2) load_once(fmi2_library_);
  return fmi2_library_;
}

std::shared_ptr<const Fmi3Library> Fmu::load_fmi3_library() {
  const std::lock_guard lock(library_mutex_);
  if (fmi3_library_ || description_->fmi1 || description_->fmi2) return fmi3_library_;
  load_once(fmi3_library_);
  if (description_->promises_idle) fmi3_library_->require_idle_functions(where_);
  return fmi3_library_;
}

/// The first one is named in messages about the library.
void Fmu::load_library_for(const std::string& component, const LogSink& log) {
  {
    const std::lock_guard lock(library_mutex_);
    if (first_component_.empty()) first_component_ = component;
  }
  const auto library = load_library();
  const std::lock_guard lock(library_mutex_);
  library->add_user(component, log);
}

void Fmu::unload_library() {
  const std::lock_guard lock(library_mutex_);
  fmi1_library_.reset();
  fmi2_library_.reset();
  fmi3_library_.reset();
}

/// Of its name, and of what its loading has changed of the process.
void Fmu::warn_of_library(const std::string& name, const InstanceOptions& options) {
  const auto library = load_library();
  const std::vector<std::string>& changes = library->changes();
  if (!options.log || has_warned_of_library_.exchange(true)) return;
  if (!library->python().empty()) {
    options.log(name, Status::Ok, "stride",
                fmt::format("its library embeds Python and is not linked with it: '{}' was loaded "
                            "for it",
                            library->python()));
  }
  for (const fs::path& companion : library->companions()) {
    options.log(name, Status::Ok, "stride",
                fmt::format("its library needs '{}', which was loaded for it", companion.string()));
  }
  for (const std::string& namesake : library->namesakes()) {
    options.log(name, Status::Ok, "stride",
                fmt::format("its library brings '{}' along, and another library of this name is in "
                            "the process: it has its own, by another name",
                            namesake));
  }
  for (const std::string& warning : library->warnings()) {
    options.log(name, Status::Warning, "stride", warning);
  }
  if (!library_warning_.empty()) options.log(name, Status::Warning, "stride", library_warning_);
  if (!library->prefix().empty()) {
    options.log(name, Status::Warning, "stride", prefix_note(library->prefix()));
  }
  if (changes.empty()) return;
  options.log(name, Status::Warning, "stride",
              fmt::format("the loading of its library changed {}, which all code in the process "
                          "shares; it is put back: link the unit without -ffast-math, and let "
                          "its initialization leave the rest as it was",
                          fmt::join(changes, ", ")));
}

std::unique_ptr<core::Unit> Fmu::instantiate(const std::string& name, InstanceOptions options) {
  if (description_->needs_execution_tool && options.log) {
    options.log(
        name, Status::Ok, "stride",
        fmt::format("'{}' needs the tool that made it ({}) on this machine", shown_as_.string(),
                    description_->generation_tool.empty() ? "which it does not name"
                                                          : description_->generation_tool));
  }
  // also read by the library when it is loaded
  if (!options.results.empty()) ::setenv("STRIDE_RESULTS", options.results.c_str(), 1);
  if (++instances_ > kMostWatched) options.process = nullptr;
  load_library_for(name, options.log);  // whose errors come before those of the instance
  warn_of_library(name, options);
  const auto tenancy = std::make_shared<Tenancy>(shared_from_this(), name, options.where);
  UnitParts parts{options.description ? options.description : description_, "", tenancy};
  if (description_->fmi1) {
    parts.resources = core::file_uri(folder());
    return std::make_unique<Fmi1Unit>(
        name, load_fmi1_library(),
        std::shared_ptr<const Fmi1Attributes>(description_, &*description_->fmi1), std::move(parts),
        std::move(options));
  }
  if (description_->fmi2) {
    parts.resources = core::file_uri(resources_);
    return std::make_unique<Fmi2Unit>(
        name, load_fmi2_library(),
        std::shared_ptr<const Fmi2Attributes>(description_, &*description_->fmi2), std::move(parts),
        std::move(options));
  }
  parts.resources = resource_path(resources_);
  return std::make_unique<Fmi3Unit>(name, load_fmi3_library(), std::move(parts),
                                    std::move(options));
}

}  // namespace stride::importer
