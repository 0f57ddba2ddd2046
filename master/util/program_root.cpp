#include "master/util/program_root.h"

#include <system_error>

namespace stride::core {

std::filesystem::path program_root() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  return program.parent_path().parent_path();
}

}  // namespace stride::core
