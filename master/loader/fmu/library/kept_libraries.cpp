#include "master/loader/fmu/library/kept_libraries.h"

#include <utility>

namespace stride::importer {
namespace {

/// They go with the process, unlike the libraries.
std::vector<std::shared_ptr<const UnpackedFmu>>& kept_files() {
  static std::vector<std::shared_ptr<const UnpackedFmu>> files;
  return files;
}

}  // namespace

KeptLibraries& KeptLibraries::of_process() {
  static auto& libraries = *new KeptLibraries;  // never destroyed, since they cannot be unloaded
  return libraries;
}

void KeptLibraries::keep(const std::string& digest, std::shared_ptr<const SharedLibrary> library,
                         std::shared_ptr<const UnpackedFmu> files) {
  const std::lock_guard lock(mutex_);
  const auto [entry, is_new] = libraries_.try_emplace(digest, std::move(library));
  if (!is_new) return;
  entry->second->forget_user();
  kept_files().push_back(std::move(files));
}

std::shared_ptr<const SharedLibrary> KeptLibraries::find(const std::string& digest) const {
  const std::lock_guard lock(mutex_);
  const auto found = libraries_.find(digest);
  if (found == libraries_.end() || found->second->is_unusable()) return nullptr;
  return found->second;
}

bool KeptLibraries::is_empty() const {
  const std::lock_guard lock(mutex_);
  return libraries_.empty();
}

}  // namespace stride::importer
