// A trace that SystemC writes.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_TRACE_SYSTEMC_TRACE_H
#define STRIDE_TESTS_MASTER_OBSERVE_TRACE_SYSTEMC_TRACE_H

#include <filesystem>

namespace stride::trace {

/// Runs a device that works for a moment, then rests for a while, again and again, for 5 s of true
/// time, and traces it with sc_trace to `file` (.vcd). With `skips`, it rests for 100 ns of kernel
/// time only and traces in advanceTime how much it has left out.
void write_systemc_trace(const std::filesystem::path& file, bool skips);

}  // namespace stride::trace

#endif
