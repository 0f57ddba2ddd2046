#ifndef STRIDE_MASTER_REPORT_SIGNALS_FILE_H
#define STRIDE_MASTER_REPORT_SIGNALS_FILE_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/report/column.h"
#include "master/report/notes.h"
#include "master/report/run_file.h"
#include "master/report/table.h"

namespace stride::report {

/// signals.csv. Times grow strictly: of several rows at one instant the last one counts.
struct Signals {
  std::vector<Time> times;
  std::vector<Column> columns;
  std::size_t left_out = 0;            ///< columns behind these, which were not read
  std::optional<std::size_t> thinned;  ///< rows of each block of which only the extremes were kept
};

/// The columns of signals.csv behind the time. `infos`: what run.json contains about them; of
/// others the type follows from their fields.
std::vector<Column> signal_columns(std::span<const std::string> headings,
                                   std::span<const SignalInfo> infos);

/// Appends to each of them its field of the table's present row. Throws core::Error (Input).
void append_fields(std::span<Column> columns, const Table& table);

struct SignalLimits {
  std::size_t columns = 10'000;
  std::size_t values = 20'000'000;
};

/// Reads signals.csv. `infos`: as of signal_columns(). Columns above the limit are not read. More
/// values than the limit are thinned while they are read, so that there are never more than three
/// times as many in memory, however long the file is; where the extremes of all columns alone, with
/// their rows, are more than the limit, twice those. Adds to the notes what was cut off or left
/// out. Throws core::Error (Input).
Signals read_signals(const std::filesystem::path& file, std::span<const SignalInfo> infos,
                     const SignalLimits& limits, Notes& notes);

}  // namespace stride::report

#endif
