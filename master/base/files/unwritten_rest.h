#ifndef STRIDE_MASTER_BASE_FILES_UNWRITTEN_REST_H
#define STRIDE_MASTER_BASE_FILES_UNWRITTEN_REST_H

#include <climits>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "master/base/files/file_identity.h"
#include "master/base/text/fixed_text.h"

namespace stride::core {

/// What an open text file holds in memory, and where that belongs: enough for another process to
/// write it.
struct UnwrittenRest {
  static constexpr std::size_t kMostOutliving = 16;
  static constexpr std::size_t kCapacity = std::size_t{1} << 16;

  char* end() { return bytes + size; }

  FixedText<PATH_MAX> path{};  ///< absolute; empty for what is no regular file, or was closed
  FileIdentity identity{};
  std::int64_t place = 0;     ///< of the first byte in the file
  std::int64_t line_end = 0;  ///< behind the last line feed before that
  std::size_t size = 0;
  char bytes[kCapacity];

  /// Writes the whole lines, be it once more, and cuts off what follows the last one in the file.
  /// Returns the size that it has then; nothing if that fails (errno). For signal handlers.
  std::optional<std::int64_t> write_to(int file) const noexcept;
  /// Likewise to the file of the path, unless there is another one.
  void write() const;
};

}  // namespace stride::core

#endif
