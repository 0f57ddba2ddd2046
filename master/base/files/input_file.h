// Files that others have made: none of them can block stride, fill its memory or be a device.
#ifndef STRIDE_MASTER_BASE_FILES_INPUT_FILE_H
#define STRIDE_MASTER_BASE_FILES_INPUT_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "master/base/error.h"
#include "master/base/files/descriptor.h"

namespace stride::core {

/// A text, such as XML or JSON, may have so many bytes.
inline constexpr std::uintmax_t kMostText = std::uintmax_t{256} << 20;

/// Opens a regular file to read it; links that lead to one are followed. Throws Error (Input), at
/// the file, which complaints call `shown_as`, or by its path, for what is missing, not readable or
/// something else: a folder, a FIFO, a socket, a device. None of these is waited for. Throws Error
/// (Run) where the process cannot open any file.
Descriptor open_input(const std::filesystem::path& file, const std::string& shown_as = "");
/// Likewise; the error is at the line that names the file.
Descriptor open_input(const std::filesystem::path& file, const Location& where);

/// The whole content of such a file. Throws Error (Input) also for more than `most` bytes, whether
/// the file has them already or grows meanwhile.
std::string read_input(const std::filesystem::path& file, const std::string& shown_as = "",
                       std::uintmax_t most = kMostText);

/// The first bytes, fewer where there are fewer; none where the file cannot be read.
std::string head_of(const std::filesystem::path& file, std::size_t count);

/// Whether the file is what Git has in place of a large one (Git LFS) that was not fetched.
bool is_lfs_pointer(const std::filesystem::path& file);
/// Likewise, of what a file holds.
bool begins_as_lfs_pointer(std::string_view content);
inline constexpr const char* kLfsPointer = "a pointer of Git LFS";
inline constexpr const char* kLfsHint = "fetch the file itself in its repository: git lfs pull";

/// Copies such a file to a new one. Throws Error (Input) where it cannot be read, and Error (Run)
/// where the copy cannot be written.
void copy_input(const std::filesystem::path& file, const std::filesystem::path& copy);

/// Reads up to `count` bytes; fewer only at the end of the file. Throws std::system_error.
std::size_t read_from(const Descriptor& file, char* bytes, std::size_t count);

/// What a path leads to, without exceptions: where it cannot be examined, there is nothing.
inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}
inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}
inline bool path_exists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// The paths of what is in the folder, sorted: none, or not all, where it cannot be read.
std::vector<std::filesystem::path> folder_entries(const std::filesystem::path& folder);

/// Whether symbolic links that lead to each other are in the way.
bool is_link_loop(const std::filesystem::path& path);
inline constexpr const char* kLinkLoopHint =
    "a symbolic link on this path leads back to itself (ls -l shows where it leads): remove it, or "
    "name another path";

/// Why there is nothing at a path, if that is not simply so: "File name too long", "Too many levels
/// of symbolic links", "Permission denied"; otherwise empty.
std::string why_unreachable(const std::filesystem::path& path);

}  // namespace stride::core

#endif
