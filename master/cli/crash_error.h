// The error of a process that a unit in it ends, in words.
#ifndef STRIDE_MASTER_CLI_CRASH_ERROR_H
#define STRIDE_MASTER_CLI_CRASH_ERROR_H

#include <span>
#include <string_view>

#include "master/importer/fmu_instance.h"
#include "master/util/error.h"

namespace stride::cli {

/// How the process ends, in words; `signal` 0 is exit() and its like.
std::string_view describe_end(int signal, std::span<char> text);

/// `end` is how the process ends, `calls` are those of units that have not returned. If this thread
/// makes none of them, a unit has started it. `is_leaving`: the command is over.
core::Error error_of(std::string_view end, std::span<const importer::UnitCall> calls,
                     bool is_leaving);

}  // namespace stride::cli

#endif
