#include "master/observe/recorders/unit_folders.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include <stride/value_text.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/untrusted_folder.h"
#include "master/observe/recorders/results_folder.h"

namespace stride::recorders {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<char, std::string_view>, 3> kCodes{
    {{'%', "%25"}, {'/', "%2F"}, {'.', "%2E"}}};
constexpr const char* kNoName = "%";
/// No code, so no other name has it.
constexpr std::string_view kShortened = "%~";
constexpr std::size_t kHashDigits = 16;

/// FNV-1a, http://www.isthe.com/chongo/tech/comp/fnv/
std::uint64_t hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// The same name if a file system allows it.
std::string shortened(const std::string& name) {
  constexpr std::size_t kLongest = 255;
  if (name.size() <= kLongest) return name;
  const std::size_t kept = whole_characters(name, kLongest - kShortened.size() - kHashDigits);
  return fmt::format("{}{}{:0{}x}", std::string_view(name).substr(0, kept), kShortened, hash(name),
                     kHashDigits);
}

bool is_shortened(std::string_view name) {
  return name.size() > kHashDigits &&
         name.substr(0, name.size() - kHashDigits).ends_with(kShortened);
}

bool is_picture(const fs::path& file) {
  const std::string number = file.stem().string();
  return file.extension() == ".jpg" && number.find_first_not_of("0123456789") == std::string::npos;
}

/// Nothing but what a film consists of: the folder may be a user's own.
void remove_film(const fs::path& unit) {
  std::error_code ignored;  // what cannot be removed fails where it is to be replaced
  const fs::path film = unit / kFilmFolder;
  for (const fs::path& folder : {unit, film}) {  // links lead to what is not a film
    if (!fs::is_directory(fs::symlink_status(folder, ignored))) return;
  }
  if (!fs::exists(film / kFilmList, ignored)) return;
  std::vector<fs::path> goes;
  std::ranges::copy_if(core::folder_entries(film), std::back_inserter(goes), is_picture);
  goes.insert(goes.end(), {film / kFilmList, film});
  for (const fs::path& path : goes) fs::remove(path, ignored);
  ::rmdir(unit.c_str());  // where nothing else is in it
}

void remove_scene(const fs::path& unit) {
  std::error_code ignored;
  if (!fs::is_directory(fs::symlink_status(unit, ignored))) return;
  for (const char* name : kSceneFiles) {
    const fs::path file = unit / name;
    if (fs::is_regular_file(fs::symlink_status(file, ignored))) fs::remove(file, ignored);
  }
  ::rmdir(unit.c_str());  // where nothing else is in it
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (!error) return;
  core::fail_output(error, {.where = {folder.string(), 0}},
                    "cannot make this folder for files of a unit", "choose another results folder");
}

}  // namespace

std::string unit_folder_name(std::string_view component) {
  if (component.empty()) return kNoName;
  const bool is_special = component == "." || component == "..";
  std::string name;
  for (const char c : component) {
    const auto* const code = std::ranges::find(kCodes, c, &decltype(kCodes)::value_type::first);
    if (code == kCodes.end() || (c == '.' && !is_special)) {
      name += c;
    } else {
      name += code->second;
    }
  }
  return shortened(name);
}

std::string component_of_folder(std::string_view name) {
  if (name == kNoName) return "";
  const bool is_cut = is_shortened(name);
  if (is_cut) name.remove_suffix(kShortened.size() + kHashDigits);
  std::string component;
  while (!name.empty()) {
    const auto* const code =
        std::ranges::find_if(kCodes, [&](const auto& c) { return name.starts_with(c.second); });
    const bool is_coded = code != kCodes.end();
    component += is_coded ? code->first : name.front();
    name.remove_prefix(is_coded ? code->second.size() : 1);
  }
  return is_cut ? component + "…" : component;
}

fs::path unit_folder(const fs::path& results, std::string_view component) {
  return results / kUnitsFolder / unit_folder_name(component);
}

bool is_in_unit_folders(const fs::path& results, const fs::path& file) {
  const fs::path units = fs::absolute(results / kUnitsFolder).lexically_normal();
  const fs::path named = fs::absolute(file).lexically_normal();
  return is_below(named, units) || is_below(resolved(named), resolved(units)) ||
         is_below(resolved(named.parent_path()), resolved(units));
}

bool has_unit_files(const fs::path& results) {
  const std::vector<fs::path> units = core::folder_entries(results / kUnitsFolder);
  return std::ranges::any_of(
      units, [](const fs::path& unit) { return !core::folder_entries(unit).empty(); });
}

void clean_unit_folders(const fs::path& results, std::span<const std::string> components) {
  const fs::path units = results / kUnitsFolder;
  for (const std::string& component : components) {
    core::UntrustedFolder(unit_folder(results, component)).remove_special_files();
  }
  for (const fs::path& unit : core::folder_entries(units)) remove_film(unit);
  for (const fs::path& unit : core::folder_entries(units)) remove_scene(unit);
  ::rmdir(units.c_str());
}

UnitFolders::UnitFolders(const fs::path& results, std::span<const std::string> components) {
  const fs::path absolute = fs::absolute(results);  // a unit may change the working folder
  folders_.push_back(absolute / kUnitsFolder);
  make_folder(folders_.back());
  for (const std::string& component : components) {
    folders_.push_back(unit_folder(absolute, component));
    make_folder(folders_.back());
  }
}

UnitFolders::~UnitFolders() {
  std::ranges::for_each(folders_.rbegin(), folders_.rend(),
                        [](const fs::path& folder) { ::rmdir(folder.c_str()); });
}

}  // namespace stride::recorders
