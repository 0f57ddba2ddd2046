// All rows of signals.csv in memory.
#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_RECORDED_SIGNALS_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_RECORDED_SIGNALS_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/report/column.h"

namespace stride::compare {

/// Of several rows at one instant none is dropped, unlike in report::Signals.
struct RecordedSignals {
  std::vector<Time> times;  ///< not descending
  std::vector<report::Column> columns;
  std::optional<std::size_t> cut;  ///< the line that was cut off
};

/// `infos`: what run.json contains about the columns. Throws core::Error (Input).
RecordedSignals read_recorded_signals(const std::filesystem::path& file,
                                      std::span<const report::SignalInfo> infos);

}  // namespace stride::compare

#endif
