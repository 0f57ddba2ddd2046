#include "master/system/plan/kept_descriptions.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/archive/zip.h"
#include "master/base/files/input_file.h"
#include "master/loader/network/description_files.h"
#include "master/system/scenario/remote_units.h"

namespace stride::scenario {
namespace {

namespace fs = std::filesystem;

// in the archive, each unit has a folder with these and with the files of its description
constexpr const char* kKey = "key";
constexpr const char* kPath = "path";
constexpr const char* kFiles = "fmu/";

void add(archive::Contents& contents, const std::string& folder, const fs::path& key,
         const importer::Fmu& fmu) {
  contents[folder + kKey].text = key.string();
  contents[folder + kPath].text = fmu.path().string();
  for (importer::DescriptionFile& file : fmu.description_files()) {
    contents[folder + kFiles + file.name].text = std::move(file.text);
  }
}

std::vector<importer::DescriptionFile> files_in(const fs::path& folder) {
  std::vector<importer::DescriptionFile> files;
  for (const char* const name : importer::kDescriptionFiles) {
    const fs::path file = folder / kFiles / name;
    if (core::path_exists(file)) files.push_back({name, core::read_input(file)});
  }
  return files;
}

}  // namespace

void keep_descriptions(std::span<const RunPlan* const> scenarios, const fs::path& file) {
  archive::Contents contents;
  std::set<fs::path> known;
  for (const RunPlan* const loaded : scenarios) {
    for (std::size_t i = 0; i < loaded->fmus().size(); ++i) {
      if (!loaded->stays_elsewhere(i)) continue;
      const fs::path key = key_of(*loaded->hostings()[i]->remote);
      const std::string folder = std::to_string(known.size()) + '/';
      if (known.insert(key).second) add(contents, folder, key, *loaded->fmus()[i]);
    }
  }
  if (!contents.empty()) archive::write_zip(file, contents);
}

UnitStore kept_descriptions(const fs::path& file) {
  UnitStore units;
  if (!core::path_exists(file)) return units;
  const archive::UnpackedArchive kept(file, "descriptions of units, as stride campaign keeps them");
  for (std::size_t i = 0;; ++i) {
    const fs::path folder = kept.folder() / std::to_string(i);
    if (!core::is_folder(folder)) return units;
    units[core::read_input(folder / kKey)] = remote::make_described_fmu(
        files_in(folder), {file.string(), 0}, core::read_input(folder / kPath));
  }
}

}  // namespace stride::scenario
