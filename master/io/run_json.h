#ifndef STRIDE_MASTER_IO_RUN_JSON_H
#define STRIDE_MASTER_IO_RUN_JSON_H

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "master/core/simulation.h"
#include "master/core/statistics.h"
#include "master/core/system.h"
#include "master/core/verdict.h"

namespace stride::io {

/// run.json: what was run, how far it came, and what each unit did and cost. Times are in seconds.
/// The wall-clock times differ from run to run, so unlike the other results this file does, too.
/// `error` is the message of the error that ended the run, if one did. Throws core::Error.
void write_run_json(const std::filesystem::path& file, const std::filesystem::path& scenario,
                    const core::System& system, const core::RunOptions& options,
                    const core::RunStatistics& statistics,
                    std::span<const core::Verdict> verdicts = {},
                    const std::optional<std::string>& error = std::nullopt);

}  // namespace stride::io

#endif
