// The folder of a run's results: its files, and what is drawn of them.
#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_RESULTS_FOLDER_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_RESULTS_FOLDER_H

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "master/base/files/descriptor.h"

namespace stride::recorders {

/// File names inside the results folder; empty = not written.
struct ResultFiles {
  std::string signals = "signals.csv";
  std::string events = "events.csv";
  std::string trace = "signals.vcd";
  std::string activity = "activity.csv";
  std::string statistics = "run.json";
  std::string report = "report.html";
  std::string coverage = "coverage.json";
};

/// Each of them, with the attribute that names it.
inline constexpr std::array<std::pair<const char*, std::string ResultFiles::*>, 7> kResultFiles{
    {{"signals", &ResultFiles::signals},
     {"events", &ResultFiles::events},
     {"trace", &ResultFiles::trace},
     {"activity", &ResultFiles::activity},
     {"statistics", &ResultFiles::statistics},
     {"report", &ResultFiles::report},
     {"coverage", &ResultFiles::coverage}}};

/// Signals that share a diagram, by the names of their columns in signals.csv.
struct Plot {
  std::string title;
  std::vector<std::string> signals;
  bool operator==(const Plot&) const = default;
};

/// Whether it names a file in the results folder itself.
bool is_plain_file_name(const std::string& name);

/// Whether a path is this folder or in it, as both are written.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Where a path leads to, as an absolute path without links; also that of a link to what does not
/// exist yet. As it is written where it cannot be examined.
std::filesystem::path resolved(std::filesystem::path path);

/// Makes the folder, and those above it, where they do not exist. Throws core::Error (Input) if
/// that is not possible, or if it is not a folder in which files can be written.
void make_results_folder(const std::filesystem::path& folder);

/// Throws core::Error (Input) for a name that is longer than the folder's file system allows, which
/// some files would only meet at the end of a run.
void check_name_lengths(const std::filesystem::path& folder, const ResultFiles& files);

/// Keeps other runs out of a results folder for as long as it lives, also if the process is killed.
class ResultsLock {
 public:
  /// Throws core::Error (Input), with the number and the name of the process, if another one has
  /// locked the folder: a run that writes there, or a unit. Where the file system has no locks
  /// (flock) there is none.
  explicit ResultsLock(const std::filesystem::path& folder);

 private:
  core::Descriptor folder_;
};

/// The files of these names that an earlier run has left go before the next one begins: what that
/// does not write itself, or not before it is killed, would be taken for its own.
void remove_results(const std::filesystem::path& folder, const ResultFiles& files);

}  // namespace stride::recorders

#endif
