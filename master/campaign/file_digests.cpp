#include "master/campaign/file_digests.h"

#include "master/scenario/unit_path.h"
#include "master/util/input_file.h"
#include "master/util/sha256.h"

namespace stride::campaign {

namespace fs = std::filesystem;

const std::string& FileDigests::file(const fs::path& path) {
  std::string& digest = known_[path];
  if (digest.empty()) digest = core::sha256_of_file(path);
  return digest;
}

const std::string& FileDigests::folder(const fs::path& path) {
  std::string& digest = known_[path];
  if (digest.empty()) digest = core::sha256_of_folder(path);
  return digest;
}

std::map<std::string, std::string> FileDigests::files(const scenario::Scenario& scenario) {
  std::map<std::string, std::string> digests;
  const fs::path around = fs::absolute(scenario.path).lexically_normal().parent_path();
  for (const fs::path& document : scenario.files->documents()) {
    if (!core::is_file(document)) continue;  // of an FMU alone, which is a unit
    const fs::path shown = fs::absolute(scenario.files->shown(document)).lexically_normal();
    digests[shown.lexically_relative(around).generic_string()] = file(document);
  }
  return digests;
}

std::string FileDigests::unit(const scenario::LoadedScenario& loaded, std::size_t component) {
  const fs::path path = scenario::find_unit(loaded.scenario().sources[component], {});
  if (core::is_folder(path)) return folder(path);
  const fs::path& resources = loaded.fmus()[component]->resources();
  if (path.extension() != ".so" || !core::is_folder(resources)) return file(path);
  return core::sha256(file(path) + folder(resources));
}

}  // namespace stride::campaign
