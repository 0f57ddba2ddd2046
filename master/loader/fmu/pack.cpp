#include "master/loader/fmu/pack.h"

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>

#include <stride/xml_text.h>

#include "master/base/archive/zip.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/process/process_state.h"
#include "master/base/text/lower_case.h"
#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/description/idle_manifest.h"
#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/library/fmi3_library.h"
#include "master/loader/fmu/library/library_file.h"
#include "master/loader/fmu/library/needed_libraries.h"
#include "master/loader/fmu/library/symbol_scope.h"
#include "master/loader/fmu/library/unpacked_fmu.h"

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
      const fs::path path = fs::absolute(library);
      const SymbolScope scope = find_symbol_scope(read_libraries(path));
      void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | scope.flags);
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

std::string name_in_binaries(const std::string& file) {
  return fmt::format("binaries/{}/{}", platform(), file);
}

/// Of names that a unit uses without defining them, or defines otherwise than they are known.
std::vector<std::string> unit_of_measure_warnings(const core::UnitDescription& unit) {
  std::vector<std::string> warnings;
  std::set<std::string> said;
  for (const core::Variable& variable : unit.variables) {
    const std::string& name = variable.unit;
    if (name.empty() || !said.insert(name).second) continue;
    const auto known = find_unit_of_measure(name);
    const auto own = unit.units_of_measure.find(name);
    if (own == unit.units_of_measure.end()) {
      if (known) continue;
      warnings.push_back(
          fmt::format("nothing defines '{}', the unit of measure of '{}': it can be connected to "
                      "the same name only",
                      name, variable.name));
    } else if (known && !core::is_nearly_same(own->second, *known)) {
      warnings.push_back(fmt::format(
          "the unit of measure '{}' of '{}' has a definition of its own, which is used and is "
          "not what '{}' commonly stands for",
          name, variable.name, name));
    }
  }
  return warnings;
}

/// With the description that the library gives for these resources.
archive::Contents describe(const PackRequest& request, std::vector<std::string>& warnings) {
  const auto& [file, resources, bundled, output, model_name] = request;
  core::open_input(file);
  const Fmi3Library library(file);
  std::string xml = library.describe(resources);
  if (!model_name.empty()) set_model_name(xml, model_name);
  auto description = parse_model_description(xml, file.string());
  const std::vector<std::string> odd = unit_of_measure_warnings(description);
  warnings.insert(warnings.end(), odd.begin(), odd.end());
  archive::Contents contents;
  contents["modelDescription.xml"].text = xml;
  const std::string manifest = library.idle_manifest(resources);
  if (!manifest.empty()) {
    parse_idle_manifest(manifest, file.string(), description);
    contents[STRIDE_IDLE_MANIFEST].text = manifest;
  }
  archive::add_file(contents, name_in_binaries(description.model_identifier + ".so"), file, true);
  if (!resources.empty()) archive::add_folder(contents, "resources/", resources);
  return contents;
}

archive::Contents collect(const PackRequest& request, std::vector<std::string>& warnings) {
  const Preloaded bundled(request.bundled);
  archive::Contents contents = describe(request, warnings);
  for (const fs::path& library : request.bundled) {
    archive::add_file(contents, name_in_binaries(library.filename().string()), library, true);
  }
  return contents;
}

/// What else is in the folder of the libraries; `library`, which lies below it, is there already.
void add_other_binaries(archive::Contents& contents, const fs::path& library) {
  const fs::path beside = library.parent_path();
  archive::Contents others;
  archive::add_folder(others, "binaries/", beside.parent_path());
  const std::string folder = "binaries/" + beside.filename().string() + "/";
  others.erase(folder + library.filename().string());
  for (auto& [name, content] : others) {
    const bool is_beside = name.starts_with(folder);
    contents.emplace(is_beside ? name_in_binaries(name.substr(folder.size())) : name,
                     std::move(content));
  }
}

/// From an FMU, which may be of several platforms.
archive::Contents collect_again(const UnpackedFmu& fmu, const PackRequest& request,
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
  archive::Contents contents =
      collect({found.path, request.resources, request.bundled, request.output, request.model_name},
              warnings);
  add_other_binaries(contents, found.path);
  return contents;
}

}  // namespace

/// The kit writes the attribute once, of the root.
void set_model_name(std::string& description, const std::string& name) {
  constexpr std::string_view kBegin = "modelName=\"";
  const std::size_t found = description.find(kBegin);
  if (found == std::string::npos) return;
  const std::size_t begin = found + kBegin.size();
  description.replace(begin, description.find('"', begin) - begin, xml_escaped(name));
}

std::vector<std::string> pack(const PackRequest& request) {
  std::vector<std::string> warnings;
  if (core::lower_case(request.library.extension().string()) != ".fmu") {
    archive::write_zip(request.output, collect(request, warnings));
    return warnings;
  }
  const UnpackedFmu fmu(request.library);
  archive::write_zip(request.output, collect_again(fmu, request, warnings));
  return warnings;
}

}  // namespace stride::importer
