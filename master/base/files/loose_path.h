// Files whose names differ a little from those that are written.
#ifndef STRIDE_MASTER_BASE_FILES_LOOSE_PATH_H
#define STRIDE_MASTER_BASE_FILES_LOOSE_PATH_H

#include <filesystem>
#include <optional>

namespace stride::core {

/// What a relative path, from the folder on, can only mean. For a name that is not there, this is
/// the only one in its folder that differs from it by the case of ASCII letters, or by the form of
/// letters with marks: see composed(). Nothing if there is none, or more than one.
std::optional<std::filesystem::path> find_loosely(const std::filesystem::path& folder,
                                                  const std::filesystem::path& relative);

}  // namespace stride::core

#endif
