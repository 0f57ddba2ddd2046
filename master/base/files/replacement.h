// A file that is written as a whole or not at all.
#ifndef STRIDE_MASTER_BASE_FILES_REPLACEMENT_H
#define STRIDE_MASTER_BASE_FILES_REPLACEMENT_H

#include <filesystem>
#include <optional>

#include "master/base/files/output_file.h"

namespace stride::core {

/// Writes "FILE.stride-new" (of a long name its beginning only) beside a file and puts it in its
/// place at the end, so that no reader ever sees a half of it, and a failure leaves the old file as
/// it was. A "FILE.stride-new" that exists, such as that of a killed process, is removed; if it is
/// a link, what it leads to is not touched. What is no regular file, such as a pipe, and a path of
/// an open one, such as /dev/stdout, is written at once. A symbolic link stays; the file that it
/// leads to is replaced.
class Replacement {
 public:
  /// Throws Error (Input) if the file cannot be written.
  explicit Replacement(const std::filesystem::path& path);
  /// Without commit(), nothing is left of what was written.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Whether it is written at once: a pipe, a device, or a name of an open file.
  static bool is_at_once(const std::filesystem::path& path);

  OutputFile& file() { return *file_; }
  /// Throws Error (Run) if the file cannot be written whole.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path fresh_;  ///< empty where the target is written at once
  std::optional<OutputFile> file_;
};

}  // namespace stride::core

#endif
