#ifndef STRIDE_MASTER_OBSERVE_TRACE_COMPRESS_H
#define STRIDE_MASTER_OBSERVE_TRACE_COMPRESS_H

#include <filesystem>
#include <optional>

#include <stride/time.h>

#include "master/observe/trace/reader.h"

namespace stride::trace {

/// Two instants with changes that are further from each other than this are a gap. For a time scale
/// of more it is one tick.
inline constexpr Duration kDefaultMinGap{1'000'000'000};  // 1 ms

/// `min_gap` in ticks of the trace, rounded down; the default if there is none. Throws core::Error
/// (Input) if it is shorter than a tick.
std::int64_t min_gap_ticks(const Reader& reader, std::optional<Duration> min_gap);

/// Writes the trace with each gap shortened to `min_gap`, and with advanceTime in its first scope,
/// so that expand() restores it. Memory does not grow with the trace. Throws core::Error (Input)
/// for a trace that has advanceTime, and as Reader; (Run) if the file cannot be written whole.
/// Nothing is left of a file that fails.
///
/// The line in which the trace was cut off, if that is accepted, is returned.
std::optional<std::int64_t> compress(const std::filesystem::path& from,
                                     const std::filesystem::path& to,
                                     std::optional<Duration> min_gap, CutOff cut_off);

}  // namespace stride::trace

#endif
