// The error of a file that cannot be written.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_WRITE_ERROR_H
#define STRIDE_UNITS_MUJOCO_WORLD_WRITE_ERROR_H

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace mujoco_world {

/// With the reason in errno.
[[noreturn]] inline void fail_to_write(const std::filesystem::path& file) {
  throw std::system_error(errno, std::generic_category(), "cannot write '" + file.string() + "'");
}

}  // namespace mujoco_world

#endif
