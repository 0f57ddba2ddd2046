#include "master/loader/process/hosted_unit_spec.h"

#include <filesystem>

#include "master/base/files/input_file.h"

namespace stride::isolation {

std::vector<WritableFolder> writable_folders(const HostedUnitSpec& spec) {
  std::vector<WritableFolder> folders;
  for (const std::filesystem::path& folder : spec.host.writable) {
    folders.push_back({folder, folder.string()});
  }
  if (core::is_folder(spec.fmu->resources())) {
    folders.push_back({spec.fmu->resources(), "its resources"});
  }
  if (spec.temporary) folders.push_back({spec.temporary->path(), "a temporary folder"});
  return folders;
}

}  // namespace stride::isolation
