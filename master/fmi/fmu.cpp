#include "master/fmi/fmu.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/fmi/idle_manifest.h"
#include "master/fmi/model_description.h"

namespace stride::fmi {
namespace {

namespace fs = std::filesystem;

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
                       "use it for one component only");
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

std::shared_ptr<Fmu> Fmu::load(const fs::path& path, const core::Location& where) {
  const std::shared_ptr<Fmu> fmu(new Fmu(path, where));
  if (path.extension() == ".so" && fs::is_regular_file(path)) {
    fmu->read_bare_library();
  } else {
    fmu->read_folder();
  }
  return fmu;
}

Fmu::Fmu(fs::path path, core::Location where) : path_(std::move(path)), where_(std::move(where)) {}

void Fmu::read_folder() {
  unpacked_.emplace(path_, where_);
  resources_ = unpacked_->folder() / "resources";
  const std::string shown_as = (path_ / "modelDescription.xml").string();
  auto description = std::make_shared<core::UnitDescription>(
      read_model_description(unpacked_->folder() / "modelDescription.xml", shown_as));
  const fs::path manifest = unpacked_->folder() / STRIDE_IDLE_MANIFEST;
  if (fs::exists(manifest)) {
    read_idle_manifest(manifest, (path_ / STRIDE_IDLE_MANIFEST).string(), *description);
  }
  description_ = std::move(description);
}

void Fmu::read_bare_library() {
  library_ = std::make_shared<Library>(path_, where_);
  resources_ = fs::absolute(path_).parent_path() / "resources";
  const std::string text = library_->describe(resources_, where_);
  auto description = std::make_shared<core::UnitDescription>(
      parse_model_description(text, path_.string() + ": its own description"));
  const std::string manifest = library_->idle_manifest(resources_, where_);
  if (!manifest.empty()) {
    parse_idle_manifest(manifest, path_.string() + ": its own idle manifest", *description);
  }
  description_ = std::move(description);
}

std::shared_ptr<const Library> Fmu::load_library() {
  const std::lock_guard lock(library_mutex_);
  if (!library_) {
    library_ = std::make_shared<Library>(
        find_library(unpacked_->folder(), description_->model_identifier, where_), where_);
    if (description_->promises_idle) library_->require_idle_functions(where_);
  }
  return library_;
}

std::unique_ptr<core::Unit> Fmu::instantiate(const std::string& name, InstanceOptions options) {
  if (description_->needs_execution_tool && options.log) {
    options.log(name, fmi3OK, "stride",
                fmt::format("'{}' needs the tool that made it ({}) on this machine", path_.string(),
                            description_->generation_tool.empty() ? "which it does not name"
                                                                  : description_->generation_tool));
  }
  auto library = load_library();
  const auto tenancy = std::make_shared<Tenancy>(shared_from_this(), name, options.where);
  auto description = options.description ? options.description : description_;
  return std::make_unique<Fmi3Unit>(
      name,
      UnitParts{std::move(library), std::move(description), resource_path(resources_), tenancy},
      std::move(options));
}

}  // namespace stride::fmi
