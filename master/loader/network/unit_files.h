// Files that a unit has written on another machine come back.
#ifndef STRIDE_MASTER_LOADER_NETWORK_UNIT_FILES_H
#define STRIDE_MASTER_LOADER_NETWORK_UNIT_FILES_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "master/base/error.h"
#include "master/base/files/untrusted_folder.h"

namespace stride::remote {

/// A piece of a file, whose name is relative to the folder.
using TakePiece =
    std::function<void(const std::string& name, std::string_view bytes, bool is_first)>;

/// Calls `take` for each piece of each regular file below the folder, in the order of their names;
/// links and the like are left out. Returns what was left out or could not be read, in words; empty
/// if nothing was.
std::string read_unit_files(const std::filesystem::path& folder, const TakePiece& take);

/// Writes what the peer sends, which is not trusted, into a folder that exists, and nowhere else.
class UnitFileWriter {
 public:
  static constexpr std::size_t kMostFiles = 100'000;
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 30;

  /// `context`: whose files they are, for errors.
  explicit UnitFileWriter(std::filesystem::path folder, core::Context context = {})
      : folder_(std::move(folder)), context_(std::move(context)) {}

  /// Throws core::Error (Run) for a name that leads out of the folder, or through a link, for more
  /// than there may be, and where it cannot be written.
  void take(const std::string& name, std::string_view bytes, bool is_first);

 private:
  void make_folders(const std::filesystem::path& inside) const;
  [[noreturn]] void fail(const std::string& name, const std::string& why) const;

  std::filesystem::path folder_;
  core::Context context_;
  std::size_t files_ = 0;
  std::uintmax_t bytes_ = 0;
};

}  // namespace stride::remote

#endif
