#include "master/system/ssp/files.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stride/xml_text.h>

#include "master/base/archive/displaced_file.h"
#include "master/base/files/file_uri.h"
#include "master/base/files/input_file.h"
#include "master/base/files/loose_path.h"
#include "master/base/files/table_file.h"
#include "master/base/text/counted.h"
#include "master/base/text/lower_case.h"
#include "master/base/text/suggest.h"
#include "master/system/ssp/ssp.h"

namespace stride::ssp {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSystemFile = "SystemStructure.ssd";
constexpr const char* kPackage =
    "an SSP package (.ssp, zip), or the folder that such a package unpacks to";
constexpr const char* kDescription = "modelDescription.xml";
constexpr std::size_t kMostNames = 20;  // in a message

/// As zip archives do.
bool begins_as_archive(const fs::path& path) {
  constexpr std::string_view kBegin("PK\x03\x04", 4);
  return core::head_of(path, kBegin.size()) == kBegin;
}

bool may_be_xml(const fs::path& path) {
  constexpr std::size_t kHead = 256;
  const std::string head = core::head_of(path, kHead);
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin == head.npos || head[begin] == '<' || static_cast<signed char>(head[begin]) <= 0;
}

/// What is not XML would be an error of its first line.
void refuse_other_kind(const fs::path& path) {
  const std::string extension = core::lower_case(path.extension().string());
  if (extension == ".ssd" || extension == ".ssp" || !core::is_file(path) || may_be_xml(path))
    return;
  const std::string name = path.string();
  core::fail_input(
      {{name, 0}, {}, {}, {}},
      "this is neither a system (.ssd, .ssp), nor a unit (.fmu, .so), nor a table "
      "(.csv, .parquet, .mcap)",
      extension == ".py"
          ? fmt::format("a unit in Python is packed first: python3 -m stride.unit {}", name)
          : "");
}

/// Some of them, where the folder is none of a package but a disk.
std::vector<std::string> files_in(const fs::path& folder) {
  constexpr int kMostEntries = 1000;
  std::vector<std::string> names;
  std::error_code ignored;
  int entries = 0;
  for (fs::recursive_directory_iterator entry(folder, ignored), end;
       !ignored && entry != end && entries < kMostEntries; entry.increment(ignored), ++entries) {
    if (!core::is_file(entry->path())) continue;
    names.push_back(entry->path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<fs::path> systems_in(const fs::path& folder) {
  std::vector<fs::path> systems = archive::packed_entries(folder);
  std::erase_if(systems, [](const fs::path& path) {
    return core::lower_case(path.extension().string()) != ".ssd" || !core::is_file(path);
  });
  return systems;
}

/// The folder that was packed, and not what is in it; or the folder itself.
fs::path packed_folder(const fs::path& folder) {
  const std::vector<fs::path> entries = archive::packed_entries(folder);
  return entries.size() == 1 && core::is_folder(entries.front()) ? entries.front() : folder;
}

/// The .ssd of a package in which it is not at its top by this name.
std::optional<fs::path> find_displaced(const fs::path& folder, const std::string& name) {
  if (auto found = core::find_loosely(folder, name)) return found;
  if (name == kSystemFile) {
    const std::vector<fs::path> systems = systems_in(packed_folder(folder));
    if (systems.size() == 1) return systems.front();
    if (!systems_in(folder).empty()) return std::nullopt;
  }
  const std::vector<fs::path> found = archive::find_files(folder, name);
  return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

/// How to name one of the systems that a package has.
std::string system_hint(const fs::path& folder, const std::string& shown, const std::string& name) {
  std::vector<std::string> names;
  for (const fs::path& system : systems_in(folder)) names.push_back(system.filename().string());
  if (name != kSystemFile) return core::suggestion(name, names);
  if (!names.empty()) return fmt::format("name one of its systems: {}/{}", shown, names.front());
  if (!archive::find_files(folder, name).empty()) {
    return "it has several, in folders: pack the contents of each as a package of its own";
  }
  if (core::path_exists(folder / kDescription)) {
    return "it is an FMU: 'stride run' runs it alone, and the source of a <ssd:Component> names it";
  }
  return fmt::format("a package has its system as {} at its top", kSystemFile);
}

[[noreturn]] void fail_without_file(const fs::path& folder, const std::string& shown,
                                    const std::string& name, const core::Location& where) {
  std::vector<std::string> names = files_in(folder);
  const std::size_t more = names.size() > kMostNames ? names.size() - kMostNames : 0;
  names.resize(names.size() - more);
  std::string held = names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
  if (more > 0) held += ", and " + core::counted(more, "more file");
  core::fail_input({where, {}, {}, {}},
                   fmt::format("'{}' has no {}; it holds {}", shown, name, held),
                   system_hint(folder, shown, name));
}

/// The same file or folder, with a name at its end.
fs::path with_name(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  const fs::path named = normal.has_filename() ? normal : normal.parent_path();
  std::error_code error;
  const bool has_name = named.has_filename() && named.filename() != "." && named.filename() != "..";
  const fs::path canonical = has_name ? named : fs::canonical(path, error);
  return error ? path : canonical;
}

/// In one line, since there is no file in which another one could be looked up.
std::string system_of(const fs::path& unit) {
  const std::string name = (core::is_folder(unit) ? unit.filename() : unit.stem()).string();
  return fmt::format(
      "<ssd:SystemStructureDescription xmlns:ssd=\"{}\" version=\"2.0\" name=\"{}\">"
      "<ssd:System name=\"{}\"><ssd:Elements><ssd:Component name=\"{}\" "
      "type=\"application/x-fmu-sharedlibrary\" source=\"{}\"/></ssd:Elements></ssd:System>"
      "</ssd:SystemStructureDescription>",
      kSsd, xml_escaped(name), xml_escaped(name), xml_escaped(name),
      xml_escaped(core::uri_path(unit.filename())));
}

}  // namespace

Files::Files(UnitFinder find_unit) : find_unit_(std::move(find_unit)) {}

fs::path Files::system_file(const fs::path& path, const core::Location& where) {
  if (core::is_folder(path)) return system_file(path, kSystemFile, where);
  if (core::is_file(path)) {
    return begins_as_archive(path) ? system_file(path, kSystemFile, where) : path;
  }
  for (fs::path package = path.parent_path(); package.has_filename();
       package = package.parent_path()) {
    if (!core::is_file(package) || !begins_as_archive(package)) continue;
    return system_file(package, path.lexically_relative(package).string(), where);
  }
  return path;  // reading it fails if it is not there
}

fs::path Files::scenario_file(const fs::path& path) {
  if (!is_unit(path)) {
    const fs::path file = system_file(path);
    refuse_other_kind(file);
    return file;
  }
  return *units_.insert(with_name(path)).first;
}

bool Files::is_unit(const fs::path& path) {
  const std::string extension = core::lower_case(path.extension().string());
  if (extension == ".fmu" || (extension == ".so" && core::is_file(path))) return true;
  if (core::is_table_name(path) && !core::is_folder(path)) return true;
  const bool is_packed = core::is_file(path) && begins_as_archive(path);
  if (!is_packed && !core::is_folder(path)) return false;
  const fs::path folder = is_packed ? unpack(path, kPackage, {}) : path;
  return core::path_exists(folder / kDescription) && !find_displaced(folder, kSystemFile);
}

fs::path Files::system_file(const fs::path& package, const std::string& name,
                            const core::Location& where) {
  if (fs::path(name).has_parent_path()) {
    core::fail_input({where, {}, {}, {}},
                     fmt::format("'{}' names '{}', and the systems of a package are at its top",
                                 shown(package), name),
                     "name a .ssd at the top level of the package");
  }
  const fs::path folder = core::is_folder(package) ? package : unpack(package, kPackage, where);
  const fs::path file = folder / name;
  if (core::is_file(file)) return file;
  const auto displaced = find_displaced(folder, name);
  if (!displaced) fail_without_file(folder, shown(package), name, where);
  warn_once(core::to_text({.where = where}) +
            archive::displaced_text(shown(package), name, folder, *displaced));
  return *displaced;
}

std::vector<fs::path> Files::variants(const fs::path& path, const fs::path& file) const {
  const bool is_unit = file.extension() != ".ssd";
  if (is_unit || (!archive_of(file) && !core::is_folder(path))) return {};
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(file.parent_path())) {
    if (entry.path().extension() == ".ssd") found.push_back(entry.path());
  }
  std::ranges::sort(found);
  return found;
}

fs::path Files::unit_folder(const fs::path& source, const core::Location& where) {
  const fs::path path = find_unit_ ? find_unit_(source, where) : source;
  const fs::path folder = core::is_folder(path) ? path : unpack(path, "an FMU (.fmu, zip)", where);
  const std::vector<fs::path> descriptions = archive::find_files(folder, kDescription);
  return descriptions.size() == 1 ? descriptions.front().parent_path() : folder;
}

const fs::path& Files::unpack(const fs::path& archive, const std::string& expected,
                              const core::Location& where) {
  const std::string shown_as = shown(archive);  // before it is in the list
  auto& unpacked = archives_[archive];
  if (!unpacked) {
    unpacked = std::make_unique<archive::UnpackedArchive>(archive, expected, where,
                                                          archive::UnpackLimits{}, shown_as);
  }
  return unpacked->folder();
}

std::optional<Files::Archive> Files::archive_of(const fs::path& file) const {
  for (const auto& [archive, unpacked] : archives_) {
    if (!unpacked) continue;
    const fs::path inside = file.lexically_relative(unpacked->folder());
    if (!inside.empty() && *inside.begin() != "..") return Archive{archive, unpacked->folder()};
  }
  return std::nullopt;
}

xml::Document Files::document(const fs::path& file) {
  documents_.insert(file);
  if (auto ahead = ahead_.extract(file)) return std::move(ahead.mapped());
  return read(file);
}

const xml::Document& Files::read_ahead(const fs::path& file) {
  const auto found = ahead_.find(file);
  return found != ahead_.end() ? found->second : ahead_.emplace(file, read(file)).first->second;
}

void Files::warn_once(const std::string& warning) {
  if (std::ranges::count(warnings_, warning) == 0) warnings_.push_back(warning);
}

xml::Document Files::read(const fs::path& file) {
  xml::Document document = units_.contains(file)
                               ? xml::Document::parse(system_of(file), shown(file), kPrefixes)
                               : xml::Document(file, shown(file), kPrefixes);
  warnings_.insert(warnings_.end(), document.warnings().begin(), document.warnings().end());
  return document;
}

std::string Files::shown(const fs::path& path) const {
  const auto archive = archive_of(path);
  if (!archive) return path.string();
  return shown(archive->path) + "/" + path.lexically_relative(archive->folder).string();
}

}  // namespace stride::ssp
