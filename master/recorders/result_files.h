// The files of a run's results folder, and what is drawn of them.
#ifndef STRIDE_MASTER_RECORDERS_RESULT_FILES_H
#define STRIDE_MASTER_RECORDERS_RESULT_FILES_H

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace stride::io {

/// File names inside the results folder; empty = not written.
struct ResultFiles {
  std::string signals = "signals.csv";
  std::string events = "events.csv";
  std::string trace = "signals.vcd";
  std::string activity = "activity.csv";
  std::string statistics = "run.json";
  std::string report = "report.html";
};

/// Each of them, with the attribute that names it.
inline constexpr std::array<std::pair<const char*, std::string ResultFiles::*>, 6> kResultFiles{
    {{"signals", &ResultFiles::signals},
     {"events", &ResultFiles::events},
     {"trace", &ResultFiles::trace},
     {"activity", &ResultFiles::activity},
     {"statistics", &ResultFiles::statistics},
     {"report", &ResultFiles::report}}};

/// Signals that share a diagram, by the names of their columns in signals.csv.
struct Plot {
  std::string title;
  std::vector<std::string> signals;
  bool operator==(const Plot&) const = default;
};

}  // namespace stride::io

#endif
