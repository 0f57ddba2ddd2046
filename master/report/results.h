// A results folder, read back.
#ifndef STRIDE_MASTER_REPORT_RESULTS_H
#define STRIDE_MASTER_REPORT_RESULTS_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/observe/coverage/report.h"
#include "master/observe/recorders/results_folder.h"
#include "master/report/message_rows.h"
#include "master/report/run_file.h"
#include "master/report/signals_file.h"

namespace stride::report {

/// The rows of activity.csv with one component and kind.
struct UnitActivities {
  std::string component;
  std::string kind;
  std::vector<Time> from, until;
};

/// Pictures that a component has made of itself.
struct Film {
  std::string component;
  std::vector<Time> times;
  std::vector<std::filesystem::path> pictures;  ///< in the results folder
};

/// A picture may have so many bytes.
inline constexpr std::size_t kLargestPicture = std::size_t{16} << 20;

/// A component's world in 3D: a binary glTF 2.0 file, whose references were checked.
struct World {
  std::string component;
  std::filesystem::path file;  ///< in the results folder
};

struct Limits {
  SignalLimits signals{};
  std::size_t messages = 100'000;
  std::size_t pictures = 100'000;                          ///< of a film
  std::uintmax_t picture_bytes = std::uintmax_t{1} << 30;  ///< of a film
};

/// Whether its files may end in the middle of a line because the rest is still to be written.
enum class RunState { Over, GoingOn };

struct Results {
  /// Where they are, the pictures and the worlds.
  std::filesystem::path folder;
  RunFile run;
  Signals signals;
  std::vector<RecordedMessage> messages;
  std::vector<UnitActivities> activities;
  std::vector<Film> films;
  std::vector<World> worlds;
  std::optional<coverage::Report> coverage;
  /// In words, what is missing, cut off or left out.
  std::vector<std::string> notes;
};

/// Reads what there is of a run: a folder without run.json, or with files that were cut off when
/// the run was killed, has results, too. `files`: their names. What units have written is read as
/// of an UntrustedFolder, since they may be alive: links are left out. Rows of messages, activities
/// and films that cannot be read are left out, which is noted. Throws core::Error (Input) for a
/// mistake in the signals, which names file, line and column, and what was expected there.
Results read_results(const std::filesystem::path& folder, const recorders::ResultFiles& files,
                     const Limits& limits = {}, RunState state = RunState::Over);

/// The names in run.json, or else the usual ones. Throws core::Error (Input) where it is no
/// folder with the results of a run.
recorders::ResultFiles result_files(const std::filesystem::path& folder);

}  // namespace stride::report

#endif
