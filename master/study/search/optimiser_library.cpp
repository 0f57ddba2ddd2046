#include <string>

#include <dlfcn.h>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/program_root.h"
#include "master/study/search/optimiser.h"

namespace stride::search {

namespace fs = std::filesystem;

fs::path optimiser_library() {
  return core::program_root() / "lib" / "stride" / STRIDE_OPTIMISER_LIBRARY;
}

/// Its symbols are its own, so no unit sees them.
MakeOptimiser& load_optimisers(const fs::path& library) {
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = handle != nullptr ? ::dlsym(handle, kMakeOptimiser) : nullptr;
  if (function != nullptr) return *reinterpret_cast<MakeOptimiser*>(function);
  const char* const reason = ::dlerror();
  core::fail_input({},
                   fmt::format("the library with the optimisers cannot be loaded: {}",
                               reason != nullptr ? reason : library.c_str()),
                   "it needs pagmo, libpagmo8 of Debian; '--method random' needs neither");
}

}  // namespace stride::search
