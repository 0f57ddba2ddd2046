#ifndef STRIDE_MASTER_REPORT_SIGNALS_FILE_H
#define STRIDE_MASTER_REPORT_SIGNALS_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "master/report/column.h"
#include "master/report/notes.h"
#include "master/report/run_file.h"

namespace stride::report {

/// signals.csv. Times are in picoseconds and grow strictly: of several rows at one instant the last
/// one counts.
struct Signals {
  std::vector<std::int64_t> times;
  std::vector<Column> columns;
  std::optional<std::size_t> thinned;  ///< rows of each block of which only the extremes were kept
};

/// Reads signals.csv. `infos`: what run.json contains about its columns; of others the type follows
/// from their fields. More than `limit` values are thinned while they are read, so that there are
/// never more than three times as many in memory, however long the file is; where the extremes of
/// all columns alone, with their rows, are more than the limit, twice those. Adds to the notes what
/// was cut off. Throws core::Error (Input).
Signals read_signals(const std::filesystem::path& file, std::span<const SignalInfo> infos,
                     std::size_t limit, Notes& notes);

}  // namespace stride::report

#endif
