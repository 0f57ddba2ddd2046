#include "master/loader/network/description_files.h"

#include <algorithm>
#include <filesystem>

#include "master/base/archive/temporary_folder.h"
#include "master/base/files/output_file.h"
#include "master/base/files/sha256.h"

namespace stride::remote {
namespace {

namespace fs = std::filesystem;

/// The FMU, and the folder that its files are in.
struct DescribedFmu {
  archive::TemporaryFolder folder;
  std::shared_ptr<importer::Fmu> fmu;
};

bool is_known(const std::string& name) {
  return std::ranges::find(importer::kDescriptionFiles, name) !=
         std::end(importer::kDescriptionFiles);
}

}  // namespace

std::string description_digest(std::span<const importer::DescriptionFile> files) {
  std::string digests;
  for (const importer::DescriptionFile& file : files) {
    if (is_known(file.name)) digests += file.name + ' ' + core::sha256(file.text) + '\n';
  }
  return core::sha256(digests);
}

std::shared_ptr<importer::Fmu> make_described_fmu(std::span<const importer::DescriptionFile> files,
                                                  const core::Location& where,
                                                  const std::string& shown_as) {
  auto made = std::make_shared<DescribedFmu>();
  for (const importer::DescriptionFile& file : files) {
    if (!is_known(file.name)) continue;
    const fs::path path = made->folder.path() / file.name;
    fs::create_directories(path.parent_path());
    core::OutputFile output(path);
    output.write(file.text);
    output.close();
  }
  made->fmu = importer::Fmu::load(made->folder.path(), where, shown_as);
  return {made, made->fmu.get()};
}

}  // namespace stride::remote
