// The error of a process that a unit in it ends, in words.
#ifndef STRIDE_MASTER_CLI_CRASH_ERROR_H
#define STRIDE_MASTER_CLI_CRASH_ERROR_H

#include <span>
#include <string_view>

#include "master/importer/fmu_instance.h"
#include "master/util/error.h"

namespace stride::cli {

/// How long the process may take to end when all units are freed [s].
inline constexpr unsigned kLongestEnd = 10;

/// How the process ends: by a signal, where SIGALRM is the end of its time, or by exit() and its
/// like, which is 0. Allocates nothing but what signal_name() does; the result is in `text`.
std::string_view describe_end(int signal, std::span<char> text);

/// `end` is how the process ends, `calls` are those of units that have not returned. If this thread
/// makes none of them, a unit has started it. `is_leaving`: the command is over.
core::Error error_of(std::string_view end, std::span<const importer::UnitCall> calls,
                     bool is_leaving);

}  // namespace stride::cli

#endif
