#include "master/loader/fmu/library/loaded_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <dlfcn.h>
#include <link.h>

namespace stride::importer {
namespace {

/// A part of a library that nothing writes to.
struct Part {
  const char* address;
  std::uint64_t offset, size;  ///< in the file
};

struct Search {
  const link_map& library;
  std::vector<Part> parts;
};

int note_parts(dl_phdr_info* object, std::size_t, void* to) {
  auto& search = *static_cast<Search*>(to);
  if (object->dlpi_addr != search.library.l_addr) return 0;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) continue;
    const auto* const address = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    search.parts.push_back({address, segment.p_offset, segment.p_filesz});
  }
  return 1;
}

bool is_in_file(const Part& part, std::ifstream& file) {
  std::vector<char> bytes(part.size);
  file.seekg(static_cast<std::streamoff>(part.offset));
  file.read(bytes.data(), static_cast<std::streamsize>(part.size));
  return file && std::equal(bytes.begin(), bytes.end(), part.address);
}

/// Nothing if one of them is not there.
std::optional<bool> are_equal(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::ifstream one(a, std::ios::binary), other(b, std::ios::binary);
  if (!one || !other) return std::nullopt;
  using Bytes = std::istreambuf_iterator<char>;
  return std::equal(Bytes(one), Bytes(), Bytes(other), Bytes());
}

bool is_in_memory(const link_map& library, const std::filesystem::path& path) {
  Search search{library, {}};
  ::dl_iterate_phdr(note_parts, &search);
  std::ifstream file(path, std::ios::binary);
  return std::ranges::all_of(search.parts,
                             [&](const Part& part) { return is_in_file(part, file); });
}

}  // namespace

bool is_loaded_from_equal(const std::string& name, const std::filesystem::path& path) {
  void* const handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return true;
  link_map* place = nullptr;
  bool is_equal = ::dlinfo(handle, RTLD_DI_LINKMAP, &place) == 0;
  if (is_equal) {
    const std::optional<bool> are_equal_files = are_equal(place->l_name, path);
    is_equal = are_equal_files ? *are_equal_files : is_in_memory(*place, path);
  }
  ::dlclose(handle);
  return is_equal;
}

}  // namespace stride::importer
