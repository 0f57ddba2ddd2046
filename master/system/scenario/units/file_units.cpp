#include "master/system/scenario/units/file_units.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/base/files/table_file.h"
#include "master/base/xml/document.h"
#include "master/system/scenario/units/foreign_table.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {
namespace {

namespace fs = std::filesystem;

/// The unit's error about the file, with the path that the user gave.
std::string shown(std::string text, const fs::path& file, const fs::path& shown_as) {
  const std::size_t at = text.find(file.string());
  if (at == std::string::npos) return text;
  return text.replace(0, at + file.string().size(), shown_as.string());
}

void require_no_resources(const importer::PackRequest& request, const std::string& what,
                          const std::string& unit) {
  if (request.resources.empty() && request.bundled.empty()) return;
  core::fail_input({}, "--resources and --bundle are for the library of a unit",
                   fmt::format("{} packed with the unit {}", what, unit));
}

/// The unit with these resources, of which `file` is what the user has given.
/// Returns warnings.
std::vector<std::string> pack_unit(const std::string& unit, const fs::path& resources,
                                   const fs::path& file, const importer::PackRequest& request,
                                   const std::string& model_name = {}) {
  try {
    return importer::pack(
        {find_unit(unit + ".fmu", {}), resources, {}, request.output, model_name});
  } catch (const core::Error& failure) {
    core::fail_input({}, shown(failure.what(), file, request.library));
  }
}

/// By --capture, and no table.
bool is_captured(const fs::path& path) {
  constexpr std::string_view kBegin = "stride stimuli,";
  return core::head_of(path, kBegin.size()) == kBegin;
}

std::vector<std::string> pack_stimuli_as(const fs::path& shown_as, importer::PackRequest request) {
  const archive::TemporaryFolder resources;
  const fs::path copy = resources.path() / "stimuli.csv";
  if (core::is_foreign_table_name(request.library)) {
    write_as_csv(request.library, copy, shown_as);
  } else {
    core::copy_input(request.library, copy);
  }
  const std::string table = is_captured(request.library) ? "" : shown_as.stem().string();
  request.library = shown_as;
  return pack_unit("player", resources.path(), copy, request, table);
}

/// The files that the declaration of a program names.
struct ProgramFiles {
  /// Those to be packed: name in the resources -> where it is.
  std::map<std::string, fs::path> packed;
  bool has_outside = false;  ///< others stay where they are
  std::string model_name;    ///< of the unit; empty: the program has no name of its own
};

void add_file(ProgramFiles& files, const xml::Element& element, const fs::path& folder) {
  const auto named = element.attribute("file");
  if (!named) return;
  const fs::path path = (folder / *named).lexically_normal();
  if (!core::is_file(path)) {
    element.fail(fmt::format("file=\"{}\": there is no file {}", *named, path.string()),
                 "name it relative to this declaration");
  }
  if (element.flag("outside")) {
    files.has_outside = true;
    return;
  }
  const auto [place, is_new] = files.packed.emplace(path.filename().string(), path);
  if (is_new || place->second == path) return;
  element.fail(
      fmt::format("file=\"{}\": another file of this name is {}", *named, place->second.string()),
      "all files of a program lie in one folder when they are packed: give them "
      "different names");
}

/// Reads as much of the declaration (docs/process-protocol.md) as is needed to pack it: all
/// attributes `file`, which are relative to it; each is in the resources under its last name.
/// Throws core::Error (Input) with the line for a file that is not there, and for two of one name.
ProgramFiles program_files(const fs::path& declaration) {
  const xml::Document document(declaration);
  const xml::Element root = document.root();
  if (!root.is("", "process")) {
    root.fail(fmt::format("{} is not a declaration of a program", root.tag()),
              "its root is <process version=\"1\">: see docs/process-protocol.md");
  }
  const fs::path folder = fs::absolute(declaration).parent_path();
  ProgramFiles files;
  files.model_name = root.attribute("name").value_or("");
  for (const xml::Element& child : root.children()) add_file(files, child, folder);
  return files;
}

}  // namespace

bool is_stimuli(const fs::path& path) { return core::is_table_name(path) || is_captured(path); }

bool is_table(const fs::path& path) {
  return core::is_table_name(path) && !core::is_folder(path) &&
         !(core::is_file(path) && is_captured(path));
}

std::vector<std::string> pack_stimuli(const importer::PackRequest& request) {
  require_no_resources(request, "stimuli are", "player");
  return pack_stimuli_as(request.library, request);
}

std::shared_ptr<importer::Fmu> load_unit(const fs::path& path, const core::Location& where,
                                         const fs::path& shown_as) {
  if (!core::is_file(path) || !is_stimuli(path)) return importer::Fmu::load(path, where, shown_as);
  const archive::TemporaryFolder folder;
  const fs::path packed = folder.path() / "player.fmu";
  const fs::path name = shown_as.empty() ? path : shown_as;
  pack_stimuli_as(name, {path, {}, {}, packed});
  return importer::Fmu::load(packed, where, name);
}

bool is_program(const fs::path& path) { return path.extension() == ".xml"; }

std::vector<std::string> pack_program(const importer::PackRequest& request) {
  require_no_resources(request, "a program is", "process");
  const ProgramFiles files = program_files(request.library);
  const archive::TemporaryFolder resources;
  for (const auto& [name, path] : files.packed) core::copy_input(path, resources.path() / name);
  if (files.has_outside) {
    core::OutputFile origin(resources.path() / "origin.txt");
    origin.write(fs::absolute(request.library).lexically_normal().parent_path().string());
    origin.write('\n');
    origin.close();
  }
  const fs::path copy = resources.path() / "process.xml";
  core::copy_input(request.library, copy);
  return pack_unit("process", resources.path(), copy, request, files.model_name);
}

}  // namespace stride::scenario
