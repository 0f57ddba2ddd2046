#ifndef STRIDE_MASTER_REPORT_SIGNALS_FILE_H
#define STRIDE_MASTER_REPORT_SIGNALS_FILE_H

#include <filesystem>
#include <span>

#include "master/report/notes.h"
#include "master/report/results.h"

namespace stride::report {

/// Reads signals.csv. `infos`: what run.json contains about its columns; of others the type follows
/// from their fields. More than `limit` values are thinned while they are read, so that there are
/// never more than three times as many in memory, however long the file is; where the extremes of
/// all columns alone, with their rows, are more than the limit, twice those. Adds to the notes what
/// was cut off. Throws core::Error (Input).
Signals read_signals(const std::filesystem::path& file, std::span<const SignalInfo> infos,
                     std::size_t limit, Notes& notes);

}  // namespace stride::report

#endif
