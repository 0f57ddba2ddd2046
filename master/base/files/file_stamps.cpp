#include "master/base/files/file_stamps.h"

#include <system_error>

#include "master/base/files/input_file.h"

namespace stride::core {

namespace fs = std::filesystem;

void FileStamps::add(const fs::path& path) {
  const fs::path absolute = fs::absolute(path);
  if (!is_folder(absolute)) {
    if (const auto stamp = stamp_of(absolute)) stamps_[absolute] = stamp;
    return;
  }
  stamps_.emplace(absolute, std::nullopt);
  std::error_code unreadable;
  for (fs::recursive_directory_iterator entry(absolute, unreadable), end;
       !unreadable && entry != end; entry.increment(unreadable)) {
    stamps_.emplace(entry->path(), std::nullopt);
  }
}

std::optional<fs::path> FileStamps::changed() const {
  for (const auto& [path, before] : stamps_) {
    std::error_code gone;
    const bool is_same =
        before ? stamp_of(path) == before : fs::exists(fs::symlink_status(path, gone));
    if (!is_same) return path;
  }
  return std::nullopt;
}

std::optional<FileStamps::Stamp> FileStamps::stamp_of(const fs::path& path) {
  constexpr std::int64_t kPerSecond = 1'000'000'000;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return Stamp{{status.st_dev, status.st_ino},
               status.st_size,
               status.st_mtim.tv_sec * kPerSecond + status.st_mtim.tv_nsec};
}

}  // namespace stride::core
