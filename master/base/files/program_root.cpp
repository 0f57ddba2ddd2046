#include "master/base/files/program_root.h"

#include <system_error>

#include <dlfcn.h>
#include <link.h>

namespace stride::core {
namespace {

namespace fs = std::filesystem;

/// Of the library that this code is in; empty if it is in the program itself.
fs::path own_library() {
  Dl_info info{};
  link_map* loaded = nullptr;
  const int is_known = ::dladdr1(reinterpret_cast<const void*>(&program_root), &info,
                                 reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP);
  return is_known == 0 || loaded == nullptr ? "" : loaded->l_name;
}

}  // namespace

fs::path program_root() {
  std::error_code unknown;
  const fs::path library = fs::canonical(own_library(), unknown);
  if (library.empty()) {
    return fs::read_symlink("/proc/self/exe", unknown).parent_path().parent_path();
  }
  const fs::path root = library.parent_path().parent_path();
  // lib/x86_64-linux-gnu
  return root.filename() == "lib" ? root.parent_path() : root;
}

}  // namespace stride::core
