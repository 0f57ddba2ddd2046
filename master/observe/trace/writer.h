#ifndef STRIDE_MASTER_OBSERVE_TRACE_WRITER_H
#define STRIDE_MASTER_OBSERVE_TRACE_WRITER_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "master/base/files/replacement.h"
#include "master/observe/trace/instants.h"

namespace stride::trace {

/// Writes a value change dump. An instant at which nothing happened is left out, but for the last
/// one, which gives the length of the trace. Nothing is left of a file that is not finished.
class Writer {
 public:
  /// Throws core::Error (Input) if the file cannot be written, or is the one that is read.
  Writer(const std::filesystem::path& from, const std::filesystem::path& to);

  void write(std::string_view text) { output_.file().write(text); }
  /// Writes a stamp, unless it is the last one written.
  void write_stamp(std::int64_t stamp);
  void write_text(const Instant& instant) { instant.text.copy_to(output_.file()); }
  void write_advance_time(std::int64_t total, std::string_view code);
  /// Throws core::Error (Run) if it cannot be written whole, as all that writes.
  void finish() { output_.commit(); }

 private:
  core::Replacement output_;
  std::optional<std::int64_t> stamp_;
};

}  // namespace stride::trace

#endif
