#ifndef STRIDE_MASTER_BASE_FILES_PROGRAM_ROOT_H
#define STRIDE_MASTER_BASE_FILES_PROGRAM_ROOT_H

#include <filesystem>

namespace stride::core {

/// The folder above that of the program, or of the library, that this code is in: of a build, or
/// where stride is installed. Empty if it is not known.
std::filesystem::path program_root();

}  // namespace stride::core

#endif
