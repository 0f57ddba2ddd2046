#include "tests/build.h"

#include <stdexcept>

namespace fs = std::filesystem;

namespace stride::tests {

const bool kSanitized = STRIDE_IS_SANITIZED;

fs::path build_folder() { return STRIDE_BUILD_FOLDER; }

fs::path unit_folder() { return build_folder() / "units"; }

fs::path test_unit_folder() { return build_folder() / "tests/units"; }

fs::path unit_library(const std::string& unit) {
  const std::string file = unit + ".so";
  for (const fs::path& library :
       {build_folder() / "units" / unit / file, build_folder() / "tests/test_units" / file})
    if (fs::exists(library)) return library;
  throw std::runtime_error("this build has no unit '" + unit + "'");
}

fs::path stride_program() { return build_folder() / "bin/stride"; }

}  // namespace stride::tests
