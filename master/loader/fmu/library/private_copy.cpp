#include "master/loader/fmu/library/private_copy.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// By the names that they replace.
using NewNames = std::map<std::string, std::string>;

bool is_loaded(const std::string& name) {
  void* const handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (handle != nullptr) ::dlclose(handle);
  return handle != nullptr;
}

/// A name of the same length that differs at its beginning, where no other text in the file has
/// its end.
std::string new_name(const std::string& name, const fs::path& folder) {
  constexpr std::size_t kMostDigits = 4;
  static std::atomic<unsigned> last{0};
  const std::size_t digits = std::min(kMostDigits, name.find(".so"));
  unsigned limit = 1;
  for (std::size_t i = 0; i < digits; ++i) limit *= 16;
  for (unsigned tried = 0; tried < limit; ++tried) {
    std::string other = fmt::format("{:0{}x}", ++last % limit, digits) + name.substr(digits);
    std::ranges::replace(other, '/', '_');
    if (!core::path_exists(folder / other) && !is_loaded(other)) return other;
  }
  core::fail_run({}, fmt::format("there is no other name for the library '{}'", name));
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) {
    throw fs::filesystem_error("cannot write", path, std::make_error_code(std::errc::io_error));
  }
}

/// Only the names are others: none of them was a part of another text.
void check(const DynamicPart& before, const DynamicPart& after, const NewNames& names,
           const fs::path& file) {
  const auto is_renamed = [&](const std::string& from, const std::string& to) {
    const auto found = names.find(from);
    return to == (found == names.end() ? from : found->second);
  };
  const bool is_right = std::ranges::equal(before.needed, after.needed, is_renamed) &&
                        before.search_path == after.search_path &&
                        std::ranges::equal(before.symbols, after.symbols, {}, &DynamicSymbol::name,
                                           &DynamicSymbol::name);
  if (is_right) return;
  core::fail_run({}, fmt::format("the names in '{}' cannot be replaced", file.string()));
}

void copy_renamed(const fs::path& from, const DynamicPart& part, const fs::path& to,
                  const NewNames& names) {
  std::string bytes = core::read_input(from);
  for (const auto& [name, other] : names) {
    const std::string text = '\0' + name + '\0';
    std::size_t at = part.texts_begin;
    while ((at = bytes.find(text, at)) < part.texts_begin + part.texts_size) {
      bytes.replace(at + 1, other.size(), other);
    }
  }
  write(to, bytes);
  check(part, read_dynamic_part(to), names, from);
}

/// Links to all that is in a folder, but for one entry.
void link_all(const fs::path& from, const fs::path& to, const fs::path& except) {
  fs::create_directories(to);
  for (const fs::path& entry : core::folder_entries(from)) {
    if (entry.filename() != except) fs::create_symlink(entry, to / entry.filename());
  }
}

}  // namespace

PrivateCopy::PrivateCopy(const UnitLibraries& libraries, const std::set<std::string>& own) {
  const fs::path& unit = libraries.file;
  const fs::path beside = unit.parent_path(), binaries = beside.parent_path();
  fs::path folder = folder_.path();
  if (binaries.filename() == "binaries") {
    link_all(binaries.parent_path(), folder, binaries.filename());
    link_all(binaries, folder / "binaries", beside.filename());
    folder = folder / "binaries" / beside.filename();
  }
  link_all(beside, folder, unit.filename());
  library_ = folder / unit.filename();
  NewNames names;
  for (const NeededLibrary& library : libraries.needed) {
    if (!library.bundled.empty()) names[library.name] = new_name(library.name, folder);
  }
  copy_renamed(unit, libraries.part, library_, names);
  make_ordinary(library_, own);
  for (const NeededLibrary& library : libraries.needed) {
    if (library.bundled.empty()) continue;
    const fs::path copy = folder / names[library.name];
    copy_renamed(library.bundled, library.part, copy, names);
    make_ordinary(copy, own);
  }
}

}  // namespace stride::importer
