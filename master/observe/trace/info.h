#ifndef STRIDE_MASTER_OBSERVE_TRACE_INFO_H
#define STRIDE_MASTER_OBSERVE_TRACE_INFO_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <stride/time.h>

#include "master/observe/trace/reader.h"
#include "master/observe/trace/timescale.h"

namespace stride::trace {

/// A stretch of true time between two instants at which something was recorded [ticks].
struct Gap {
  std::int64_t from = 0;
  std::int64_t to = 0;
  std::int64_t skipped = 0;  ///< how much of it the trace leaves out

  std::int64_t length() const { return to - from; }
};

/// What a trace holds. Times are in ticks of its time scale; advanceTime counts neither as a
/// variable nor as a change.
struct Info {
  Timescale timescale;
  std::uint64_t bytes = 0;
  std::size_t variables = 0;  ///< names, some of which may share their changes
  std::uint64_t changes = 0;
  std::uint64_t instants = 0;  ///< at which something was recorded
  bool has_advance_time = false;
  std::int64_t kernel_time = 0;  ///< from the first instant to the last one
  std::int64_t true_time = 0;    ///< likewise
  std::uint64_t skips = 0;       ///< how often advanceTime grew
  std::int64_t min_gap = 0;
  std::uint64_t gaps = 0;           ///< longer than that
  std::vector<Gap> longest;         ///< ten of them at most, the longest first
  std::optional<std::int64_t> cut;  ///< the line in which the file was cut off
};

/// Reads the whole trace. Throws core::Error (Input) as Reader, AdvanceTime, InstantReader and
/// min_gap_ticks().
Info info(const std::filesystem::path& file, std::optional<Duration> min_gap, CutOff cut_off);

}  // namespace stride::trace

#endif
