#include "master/importer/pack.h"

#include <memory>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>

#include "master/importer/binaries.h"
#include "master/importer/fmi3/fmi3_library.h"
#include "master/importer/idle_manifest.h"
#include "master/importer/library_file.h"
#include "master/importer/model_description.h"
#include "master/importer/unpacked_fmu.h"
#include "master/util/archive/zip.h"
#include "master/util/error.h"
#include "master/util/input_file.h"
#include "master/util/lower_case.h"
#include "master/util/process/process_state.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// The bundled libraries do not lie beside the unit's yet; once loaded, the loader knows them by
/// their names.
class Preloaded {
 public:
  explicit Preloaded(const std::vector<fs::path>& libraries) {
    const core::ProcessState before;
    for (const fs::path& library : libraries) {
      core::open_input(library);  // the loader would wait for a FIFO
      if (const std::string damage = find_damage(library); !damage.empty()) {
        core::fail_input({}, fmt::format("the library to bundle, '{}', cannot be loaded: {}",
                                         library.string(), damage));
      }
      void* const handle = ::dlopen(fs::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
      if (handle == nullptr) {
        core::fail_input({},
                         fmt::format("the library to bundle cannot be loaded: {}", ::dlerror()));
      }
      handles_.emplace_back(handle, &::dlclose);
    }
    before.restore();
  }

 private:
  std::vector<std::unique_ptr<void, int (*)(void*)>> handles_;
};

archive::Contents collect(const PackRequest& request) {
  const Preloaded bundled(request.bundled);
  core::open_input(request.library);
  const Fmi3Library library(request.library);
  const std::string xml = library.describe(request.resources);
  auto description = parse_model_description(xml, request.library.string());
  const std::string binaries = fmt::format("binaries/{}/", platform());
  archive::Contents contents;
  contents["modelDescription.xml"].text = xml;
  const std::string manifest = library.idle_manifest(request.resources);
  if (!manifest.empty()) {
    parse_idle_manifest(manifest, request.library.string(), description);
    contents[STRIDE_IDLE_MANIFEST].text = manifest;
  }
  archive::add_file(contents, binaries + description.model_identifier + ".so", request.library,
                    true);
  for (const fs::path& library : request.bundled) {
    archive::add_file(contents, binaries + library.filename().string(), library, true);
  }
  if (!request.resources.empty()) {
    archive::add_folder(contents, "resources/", request.resources);
  }
  return contents;
}

/// The same for the library in an unpacked FMU, with what lies beside it.
PackRequest with_library_of(const UnpackedFmu& fmu, PackRequest request,
                            std::vector<std::string>& warnings) {
  if (request.resources.empty()) {
    core::fail_input({}, fmt::format("'{}' is packed already", request.library.string()),
                     "name the folder that it is to be packed again with: --resources FOLDER");
  }
  const auto description = read_model_description(fmu.description());
  const FoundLibrary found =
      find_library(fmu.folder(), description.fmi_version, description.model_identifier);
  for (const std::string& warning : {fmu.warning(), found.warning}) {
    if (!warning.empty()) warnings.push_back(warning);
  }
  request.library = found.path;
  // sorted: the order in which they are loaded
  std::vector<fs::path> beside = core::folder_entries(request.library.parent_path());
  std::erase(beside, request.library);
  request.bundled.insert(request.bundled.begin(), beside.begin(), beside.end());
  return request;
}

}  // namespace

std::vector<std::string> pack(const PackRequest& request) {
  std::vector<std::string> warnings;
  if (core::lower_case(request.library.extension().string()) != ".fmu") {
    archive::write_zip(request.output, collect(request));
    return warnings;
  }
  const UnpackedFmu fmu(request.library);
  archive::write_zip(request.output, collect(with_library_of(fmu, request, warnings)));
  return warnings;
}

}  // namespace stride::importer
