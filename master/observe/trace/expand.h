#ifndef STRIDE_MASTER_OBSERVE_TRACE_EXPAND_H
#define STRIDE_MASTER_OBSERVE_TRACE_EXPAND_H

#include <filesystem>

#include "master/observe/trace/reader.h"

namespace stride::trace {

/// Writes the trace with its true time and without advanceTime: each change of the others is at its
/// stamp plus what had been skipped then. Memory does not grow with the trace. Throws core::Error
/// (Input) for a trace without advanceTime, and as Reader, AdvanceTime and InstantReader; (Run) if
/// the file cannot be written whole. Nothing is left of a file that fails.
///
/// The line in which the trace was cut off, if that is accepted, is returned.
std::optional<std::int64_t> expand(const std::filesystem::path& from,
                                   const std::filesystem::path& to, CutOff cut_off);

}  // namespace stride::trace

#endif
